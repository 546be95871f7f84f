# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the filters are ValueErrors with their text: array, index and value; nothing is printed."""

import contextlib
import os
import tempfile
import unittest
import warnings

import numpy as np
from vtkmodules.vtkCommonCore import vtkObject

import footpoint
from shapes import OCTAGON, OCTAGON_WEIGHTS, QUARTERS, square


@contextlib.contextmanager
def standard_error():
    """What is written to standard error, by C++ too; a list that gets the text at the end."""
    text = []
    with tempfile.TemporaryFile() as file:
        saved = os.dup(2)
        os.dup2(file.fileno(), 2)
        try:
            yield text
        finally:
            os.dup2(saved, 2)
            os.close(saved)
            file.seek(0)
            text.append(file.read().decode())


def spoil(net, array, index, value):
    """Changes one number of a good net."""
    data = net.GetFieldData().GetArray(array) or net.GetPointData().GetArray(array)
    data.SetComponent(index, 0, value)
    return net


class BadGeometry(unittest.TestCase):
    def check(self, text, function, *arguments, **keywords):
        with standard_error() as printed:
            with self.assertRaisesRegex(ValueError, text) as caught:
                function(*arguments, **keywords)
        self.assertEqual(printed, [""])
        self.assertNotIn("ERROR: In", str(caught.exception))
        self.assertNotIn("0x", str(caught.exception))

    def test_knots(self):
        knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
        for index, value, text in (
            (5, 0.5, r"KnotsU\[5\]"),
            (7, np.nan, r"KnotsU\[7\] = nan"),
            (0, np.inf, r"KnotsU\[0\] = inf"),
        ):
            bad = list(knots)
            bad[index] = value
            self.check(text, footpoint.nurbs_curve, OCTAGON, bad, OCTAGON_WEIGHTS)
        self.check("KnotsU", footpoint.nurbs_curve, OCTAGON, np.zeros(12))

    def test_weights(self):
        for index, value, text in ((3, 0.0, "= 0 "), (8, -1.0, "= -1 "), (2, np.nan, "= nan ")):
            bad = OCTAGON_WEIGHTS.copy()
            bad[index] = value
            self.check(
                rf"RationalWeights\[{index}\] {text}", footpoint.nurbs_curve, OCTAGON, QUARTERS, bad
            )

    def test_control_points(self):
        bad = OCTAGON.astype(float)
        bad[4, 1] = np.nan
        self.check("control point 4 has the coordinate nan", footpoint.nurbs_curve, bad, QUARTERS)

    def test_nets_that_were_spoilt_later(self):
        for array, index, value, text in (
            ("KnotsU", 2, 7.0, r"KnotsU\[2|3\]"),
            ("KnotsV", 1, np.nan, r"KnotsV\[1\] = nan"),
            ("Degree", 1, 2, r"Degree\[1\] = 2"),
        ):
            net = spoil(square(), array, index, value)
            self.check(text, footpoint.invert, [[0, 0, 0]], net)
            self.check(text, footpoint.evaluate, net, [[0, 0]])

    def test_trimmed_faces(self):
        corners = np.array([[0, 0], [1, 0], [1, 1.0]])
        self.check("curve . of trim loop 0",
                   footpoint.trimmed_face, square(), [[corners, corners[1:]]])

    def test_one_bad_face_of_two(self):
        faces = [spoil(square(), "KnotsU", 1, np.nan), square(2)]
        with standard_error() as printed:
            with self.assertWarnsRegex(RuntimeWarning, r"Face 0: KnotsU\[1\] = nan") as caught:
                r = footpoint.invert([[0.5, 0.5, 0]], faces)
        self.assertEqual(printed, [""])
        self.assertEqual(caught.filename, __file__, "the warning points at the caller")
        self.assertEqual((r.face[0], r.distance[0]), (1, 2.0))

    def test_errors_come_even_where_vtk_is_silenced(self):
        net = spoil(square(), "KnotsU", 1, np.nan)
        vtkObject.GlobalWarningDisplayOff()
        try:
            self.check(r"KnotsU\[1\]", footpoint.invert, [[0, 0, 0]], net)
            self.assertEqual(vtkObject.GetGlobalWarningDisplay(), 0)
        finally:
            vtkObject.GlobalWarningDisplayOn()

    def test_good_after_bad(self):
        with self.assertRaises(ValueError):
            footpoint.invert([[0, 0, 0]], spoil(square(), "KnotsU", 1, np.nan))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(footpoint.invert([[0, 0, 3]], square()).distance[0], 3)


if __name__ == "__main__":
    unittest.main()
