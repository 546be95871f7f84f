# SPDX-License-Identifier: BSD-3-Clause
"""The proxies of transfinite interpolation: defaults are those of the classes, values reach them,
several inputs count together and are replaced together.
"""

import os
import unittest

from paraview import servermanager, simple

import footpoint
from footpoint._options import option_names

PROXIES = {
    "CoonsPatch": footpoint.vtkCoonsPatchSource,
    "CoonsSurface": footpoint.vtkCoonsSurface,
    "GordonSurface": footpoint.vtkGordonSurface,
    "StructuredGridSmoother": footpoint.vtkStructuredGridSmoother,
    "TransfiniteVolume": footpoint.vtkTransfiniteVolume,
}


def lines(corners):
    """A Line source from every corner to the next."""
    return [
        simple.Line(Point1=a, Point2=b) for a, b in zip(corners, corners[1:] + corners[:1])
    ]


def curve(ends):
    producer = simple.TrivialProducer()
    net = footpoint.nurbs_curve(ends, [0, 0, 1, 1])
    producer.GetClientSideObject().SetOutput(net)
    return producer


class Proxies(unittest.TestCase):
    def test_defaults(self):
        for name, algorithm_class in PROXIES.items():
            simple.SetActiveSource(None)  # would become its input
            proxy = getattr(simple, name)()
            algorithm = algorithm_class()
            for option in option_names(algorithm_class).values():
                expected = getattr(algorithm, "Get" + option)()
                element = proxy.SMProxy.GetProperty(option)
                self.assertIsNotNone(element, f"{name}.{option}")
                values = expected if isinstance(expected, tuple) else (expected,)
                given = [element.GetElement(i) for i in range(element.GetNumberOfElements())]
                self.assertEqual(given, [float(v) for v in values], f"{name}.{option}")

    def test_patch(self):
        sides = lines([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]])
        patch = simple.CoonsPatch(Input=sides)
        patch.Resolution = [5, 4]
        patch.CellType = "Triangles"
        patch.UpdatePipeline()
        grid = servermanager.Fetch(patch, idx=0)
        self.assertEqual(grid.GetDimensions(), (5, 4, 1))
        mesh = servermanager.Fetch(patch, idx=1)
        self.assertEqual(mesh.GetNumberOfPolys(), 24)
        patch.Input = lines([[0, 0, 0], [2, 0, 0], [1, 2, 0]])
        patch.UpdatePipeline()
        grid = servermanager.Fetch(patch, idx=0)
        self.assertEqual(grid.GetFieldData().GetArray("EdgeOrder").GetRange()[0], -1)

        smoother = simple.StructuredGridSmoother(Input=patch)
        smoother.Method = "Laplacian"
        smoother.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(smoother).GetDimensions(), (5, 4, 1))

    def test_surfaces(self):
        a, b, c, d = [0, 0, 0], [2, 0, 0], [2, 1, 1], [0, 1, 0]
        surface = simple.CoonsSurface(Input=[curve(e) for e in ([a, b], [b, c], [d, c], [a, d])])
        surface.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(surface).GetDimensions(), (2, 2, 1))
        gordon = simple.GordonSurface(
            Input=[curve([a, b]), curve([d, c])], Guides=[curve([a, d]), curve([b, c])]
        )
        gordon.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(gordon).GetDimensions(), (2, 2, 1))
        view = simple.CreateRenderView()
        self.addCleanup(simple.Delete, view)  # its window, before the X connection closes
        for net in (surface, gordon):
            self.assertEqual(simple.Show(net, view).Representation, "Wireframe")
        e, f = [0, 2, 0], [2, 2, 0]
        gordon.Input = [curve([a, b]), curve([e, f])]
        gordon.Guides = [curve([a, e]), curve([b, f])]
        gordon.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(gordon).GetBounds()[3], 2.0)

    def test_volume(self):
        box = simple.Wavelet(WholeExtent=[0, 2, 0, 3, 0, 4])
        faces = []
        for direction in range(3):
            for end in (0, (2, 3, 4)[direction]):
                extent = [0, 2, 0, 3, 0, 4]
                extent[2 * direction:2 * direction + 2] = [end, end]
                cut = simple.ExtractSubset(Input=box, VOI=extent)
                faces.append(simple.Transform(Input=cut))  # makes a structured grid
        volume = simple.TransfiniteVolume(Input=faces)
        volume.UpdatePipeline()
        grid = servermanager.Fetch(volume)
        self.assertEqual(grid.GetDimensions(), (3, 4, 5))
        self.assertEqual(grid.GetBounds(), (0, 2, 0, 3, 0, 4))


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    unittest.main()
