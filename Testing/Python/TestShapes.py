# SPDX-License-Identifier: BSD-3-Clause
"""Shapes from Python: names, options, kinds of output, refusals, the words on defaults."""

import inspect
import re
import unittest

import footpoint
import numpy as np
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkStructuredGrid

from footpoint._options import enumeration_methods, option_names


class Shapes(unittest.TestCase):
    def test_distances(self):
        points = np.random.default_rng(2).normal(scale=2.0, size=(300, 3))
        r = footpoint.invert(points, footpoint.nurbs_shape("sphere", radius=2.0, center=(1, 0, 0)))
        expected = np.linalg.norm(points - (1, 0, 0), axis=1) - 2.0
        np.testing.assert_allclose(r.signed_distance, expected, atol=1e-14)
        np.testing.assert_array_equal(r.status, 0)
        r = footpoint.invert(points, footpoint.nurbs_shape("torus", cross_section_radius=0.25))
        around = np.hypot(points[:, 0], points[:, 1]) - 1.0
        np.testing.assert_allclose(
            r.signed_distance, np.hypot(around, points[:, 2]) - 0.25, atol=1e-14)

    def test_every_shape_by_name_and_number(self):
        names = enumeration_methods(footpoint.vtkNURBSShapeSource, "Shape")
        self.assertEqual(len(names), 10)
        kinds = {}
        for number, name in enumerate(names):
            source = footpoint.vtkNURBSShapeSource()
            getattr(source, names[name])()
            number = source.GetShape()
            shape = footpoint.nurbs_shape(name)
            self.assertIs(type(footpoint.nurbs_shape(number)), type(shape))
            kinds.setdefault(type(shape), set()).add(name)
            feet = footpoint.invert([[0.3, 0.2, 4.0]], shape)
            self.assertEqual(feet.status[0], footpoint.Status.CERTIFIED, name)
        self.assertEqual(kinds[vtkMultiBlockDataSet], {"teapot", "shiphull"})
        self.assertEqual(len(kinds[vtkStructuredGrid]), 8)
        self.assertEqual(footpoint.nurbs_shape("ship_hull", capping=True).GetNumberOfBlocks(), 3)

    def test_curves_have_no_sign(self):
        r = footpoint.invert([[2.0, 0.0, 0.0]], footpoint.nurbs_shape("circle"))
        self.assertIsNone(r.signed_distance)
        self.assertAlmostEqual(r.distance[0], 1.0, places=14)

    def test_refusals(self):
        for text, error, shape, options in (
                ("shape = 'cube' is none of", ValueError, "cube", {}),
                ("Radius = -1; a positive, finite length", ValueError, "sphere", {"radius": -1}),
                ("AirfoilDigits = '24'; four digits", ValueError, "wing", {"airfoil_digits": "24"}),
                ("Resolution = 0; allowed is 1 to 1000", ValueError, "bumpy", {"resolution": 0}),
                ("Turns = 0; more than 0", ValueError, "helix", {"turns": 0}),
                ("no option 'radios'; near ones: radius", TypeError, "sphere", {"radios": 1})):
            with self.assertRaisesRegex(error, re.escape(text)):
                footpoint.nurbs_shape(shape, **options)

    def test_docstring(self):
        """Its defaults are those of the class."""
        doc = inspect.getdoc(footpoint.nurbs_shape)
        source = footpoint.vtkNURBSShapeSource()
        found = {}
        for names, words in re.findall(r"(?m)^([\w, ]+) : .*, default (.+)$", doc):
            names = names.split(", ")
            values = [words] if len(names) == 1 else re.split(r", | and ", words)
            self.assertEqual(len(values), len(names), names)
            found.update(zip(names, values))
        options = option_names(footpoint.vtkNURBSShapeSource)
        options.pop("shape")
        self.assertEqual(set(found), set(options))
        for name, words in found.items():
            value = getattr(source, "Get" + options[name])()
            self.assertEqual(eval(words), value, name)


if __name__ == "__main__":
    unittest.main()
