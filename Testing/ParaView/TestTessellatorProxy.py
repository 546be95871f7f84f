# SPDX-License-Identifier: BSD-3-Clause
"""The proxy SplineTessellator: defaults are those of the class, values reach it, a mesh comes out."""

import os
import unittest

from paraview import servermanager, simple

import footpoint
from footpoint._options import option_names


def dome():
    """A quarter of a cylinder, 1 x 1 spans."""
    w = 0.5**0.5
    arc = [(1, 0), (1, 1), (0, 1)]
    return footpoint.nurbs_surface(
        [[(x, y, 0), (x, y, 1)] for x, y in arc], [0, 0, 0, 1, 1, 1], [0, 0, 1, 1],
        weights=[[1, 1], [w, w], [1, 1]])


def producer(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    return source


class SplineTessellator(unittest.TestCase):
    def test_defaults(self):
        proxy = simple.SplineTessellator(Input=producer(dome()))
        algorithm = footpoint.vtkSplineTessellator()
        for option in option_names(footpoint.vtkSplineTessellator).values():
            element = proxy.SMProxy.GetProperty(option)
            self.assertIsNotNone(element, option)
            expected = float(getattr(algorithm, "Get" + option)())
            self.assertEqual(float(element.GetElement(0)), expected, option)

    def test_mesh(self):
        proxy = simple.SplineTessellator(Input=producer(dome()))
        proxy.ChordTolerance = 0.01
        proxy.UpdatePipeline()
        coarse = servermanager.Fetch(proxy).GetNumberOfPolys()
        self.assertGreater(coarse, 5)
        proxy.ChordTolerance = 0.001
        proxy.UpdatePipeline()
        mesh = servermanager.Fetch(proxy)
        self.assertGreater(mesh.GetNumberOfPolys(), 2 * coarse)
        self.assertEqual(mesh.GetPointData().GetNormals().GetName(), "Normals")
        self.assertEqual(mesh.GetPointData().GetTCoords().GetName(), "Parameters")
        proxy.Mode = "Fixed"
        proxy.Resolution = 2
        proxy.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(proxy).GetNumberOfPolys(), 2 * 4)


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    unittest.main()
