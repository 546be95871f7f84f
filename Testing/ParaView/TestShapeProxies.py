# SPDX-License-Identifier: BSD-3-Clause
"""The proxies of shapes and Bézier cells: defaults are those of the classes, values reach them, the
kind of output follows the shape, and feet come out right.
"""

import os
import unittest

from paraview import servermanager, simple

import footpoint
from footpoint._options import option_names

PROXIES = {
    "BezierExtraction": footpoint.vtkBezierExtraction,
    "NURBSShapeSource": footpoint.vtkNURBSShapeSource,
}


class Proxies(unittest.TestCase):
    def setUp(self):
        simple.SetActiveSource(None)  # would become an input

    def test_defaults(self):
        for name, algorithm_class in PROXIES.items():
            # The active source, a shape, becomes the input of the extraction.
            simple.SetActiveSource(simple.NURBSShapeSource())
            proxy = getattr(simple, name)()
            algorithm = algorithm_class()
            for option in option_names(algorithm_class).values():
                expected = getattr(algorithm, "Get" + option)()
                element = proxy.SMProxy.GetProperty(option)
                self.assertIsNotNone(element, f"{name}.{option}")
                values = expected if isinstance(expected, tuple) else (expected,)
                given = [element.GetElement(i) for i in range(element.GetNumberOfElements())]
                self.assertEqual(given, list(values), f"{name}.{option}")

    def test_shapes(self):
        shape = simple.NURBSShapeSource()
        shape.Radius = 2.0
        shape.UpdatePipeline()
        self.assertEqual(shape.GetDataInformation().GetBounds(), (-2, 2, -2, 2, -2, 2))
        sphere = servermanager.Fetch(shape)
        self.assertEqual(sphere.GetDimensions(), (9, 5, 1))
        shape.Shape = "Teapot"
        shape.UpdatePipeline()
        self.assertTrue(servermanager.Fetch(shape).IsA("vtkMultiBlockDataSet"))
        self.assertEqual(shape.GetDataInformation().GetNumberOfDataSets(), 4)
        shape.Shape = "Wing"
        shape.AirfoilDigits = "0012"
        shape.UpdatePipeline()
        wing = servermanager.Fetch(shape)
        self.assertTrue(wing.IsA("vtkStructuredGrid"))
        shape.Capping = 1
        shape.UpdatePipeline()
        self.assertEqual(shape.GetDataInformation().GetNumberOfDataSets(), 3)

    def test_bezier_cells_and_feet(self):
        shape = simple.NURBSShapeSource(Shape="Torus")
        cells = simple.BezierExtraction(Input=shape)
        cells.UpdatePipeline()
        self.assertEqual(cells.GetDataInformation().GetNumberOfCells(), 16)
        points = simple.PointSource(Center=[0, 0, 0], NumberOfPoints=50, Radius=2.0)
        for source in (shape, cells):
            feet = simple.PointInversion(Input=points, Source=source)
            feet.UpdatePipeline()
            data = servermanager.Fetch(feet, idx=0)
            for i in range(50):
                x, y, z = data.GetPoint(i)
                expected = (((x * x + y * y) ** 0.5 - 1.0) ** 2 + z * z) ** 0.5 - 0.3
                found = data.GetPointData().GetArray("SignedDistance").GetValue(i)
                self.assertAlmostEqual(found, expected, places=12)

    def test_subdivision(self):
        """The surface filter, which representations use too, puts its points on the sphere."""
        cells = simple.BezierExtraction(Input=simple.NURBSShapeSource())
        drawn = simple.ExtractSurface(Input=cells, NonlinearSubdivisionLevel=4)
        drawn.UpdatePipeline()
        surface = servermanager.Fetch(drawn)
        self.assertGreater(surface.GetNumberOfCells(), 1000)
        for i in range(surface.GetNumberOfPoints()):
            radius = sum(x * x for x in surface.GetPoint(i)) ** 0.5
            self.assertAlmostEqual(radius, 1.0, places=6)

    def test_display_of_changing_kinds(self):
        """A shape that is shown may become a model, and a single net again."""
        view = simple.CreateRenderView()
        self.addCleanup(simple.Delete, view)  # its window, before the X connection closes
        shape = simple.NURBSShapeSource()
        cells = simple.BezierExtraction(Input=shape)
        for source in (shape, cells):
            simple.Show(source, view)
        for name, bounds in (("Sphere", 1.0), ("Teapot", 3.15), ("Helix", 1.0), ("Torus", 0.3)):
            shape.Shape = name
            simple.Render(view)
            self.assertAlmostEqual(cells.GetDataInformation().GetBounds()[5], bounds, msg=name)


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    unittest.main()
