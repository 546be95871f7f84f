# SPDX-License-Identifier: BSD-3-Clause
"""The ParaView state that the demo writes: it opens the files beside it, wherever they are moved."""

import os
from pathlib import Path
import shutil
import sys
import unittest

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import footpoint

OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"]) / "inspection_state"
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Documentation" / "examples"))

from inspection.analysis import inspect  # noqa: E402
from inspection.lengths import Lengths  # noqa: E402
from inspection.output import write_points, write_state, write_vtp  # noqa: E402
from inspection.part import Part  # noqa: E402
from inspection.tessellation import tessellate  # noqa: E402

OUTLIER = 17


def write_inspection(folder):
    """A scan of the unit square, raised by 0.05, with one outlier."""
    square = footpoint.nurbs_surface(
        [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]], [0, 0, 1, 1], [0, 0, 1, 1])
    points = np.random.default_rng(1).random((2000, 3)) * [1, 1, 0.002] + [0, 0, 0.05]
    points[OUTLIER, 2] = 0.7
    inspection = inspect(points, footpoint.invert(points, square), 0.1, 1.0)
    mesh = tessellate(square, (5, 4))
    part = Part(Path("square.step"), None, mesh, [""], 0, "inch", "inch", "inch")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    write_vtp(folder / "part.vtp", mesh)
    write_points(folder / "deviation.vtp", inspection)
    write_state(folder / "paraview_state.py", part, Lengths("inch", 0.1, 0.2, 0.25),
                np.array([0.6, 0.0, 0.8]))
    return points, inspection


class State(unittest.TestCase):
    def test_state(self):
        points, inspection = write_inspection(OUTPUT / "first")
        self.assertEqual(list(np.flatnonzero(inspection.outliers)), [OUTLIER])
        shutil.rmtree(OUTPUT / "moved", ignore_errors=True)
        (OUTPUT / "first").rename(OUTPUT / "moved")
        path = OUTPUT / "moved" / "paraview_state.py"
        simple.ResetSession()
        exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), {"__file__": str(path)})

        shown = servermanager.Fetch(simple.FindSource("without outliers"))
        good = np.arange(len(points)) != OUTLIER
        np.testing.assert_array_equal(vtk_to_numpy(shown.GetPoints().GetData()), points[good])
        deviations = vtk_to_numpy(shown.GetPointData().GetArray("SignedDistance"))
        np.testing.assert_allclose(deviations, points[good, 2], atol=1e-12)
        part = servermanager.Fetch(simple.FindSource("part"))
        self.assertEqual(part.GetNumberOfPoints(), 20)

        colours = simple.GetColorTransferFunction("SignedDistance")
        self.assertEqual((colours.RGBPoints[0], colours.RGBPoints[4], colours.RGBPoints[8]),
                         (-0.2, 0.0, 0.2))
        view = simple.GetActiveView()
        self.addCleanup(simple.Delete, view)  # its window, before the X connection closes
        legend = simple.GetScalarBar(colours, view)
        self.assertEqual(legend.Title, "Deviation [inch]")
        self.assertTrue(legend.Visibility)
        toward = np.subtract(view.CameraPosition, view.CameraFocalPoint)
        np.testing.assert_allclose(toward / np.linalg.norm(toward), [0.6, 0.0, 0.8], atol=1e-6)


if __name__ == "__main__":
    unittest.main()
