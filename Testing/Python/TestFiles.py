# SPDX-License-Identifier: BSD-3-Clause
"""read_splines and write_splines: files of every format, their options, errors and warnings."""

from pathlib import Path
import tempfile
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import footpoint
from footpoint._pipeline import to_vtk
from shapes import circle, sphere, square

equal = np.testing.assert_array_equal


def compare(data, expected):
    """Equal structure and numbers of two nets or composites."""
    if expected.IsA("vtkMultiBlockDataSet"):
        assert data.GetNumberOfBlocks() == expected.GetNumberOfBlocks()
        for i in range(expected.GetNumberOfBlocks()):
            compare(data.GetBlock(i), expected.GetBlock(i))
        return
    assert data.GetDimensions() == expected.GetDimensions()
    equal(vtk_to_numpy(data.GetPoints().GetData()), vtk_to_numpy(expected.GetPoints().GetData()))
    for of in ("GetFieldData", "GetPointData"):
        arrays, others = getattr(data, of)(), getattr(expected, of)()
        for i in range(others.GetNumberOfArrays()):
            other = others.GetArray(i)
            equal(vtk_to_numpy(arrays.GetArray(other.GetName())), vtk_to_numpy(other))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_round_trips(self):
        surfaces = [sphere(), square(1 / 3)]
        for faces in (surfaces, [circle(0.1), circle(2)]):
            for extension in ("xml", "g2", "json"):
                path = self.folder / f"model.{extension}"
                footpoint.write_splines(faces, path)
                compare(footpoint.read_splines(path), footpoint.model(faces))
        footpoint.write_splines(sphere(), str(self.folder / "one.g2"))
        reader = footpoint.vtkSplineReader()
        reader.SetFileName(str(self.folder / "one.g2"))
        footpoint.write_splines(reader, self.folder / "again.xml")
        compare(footpoint.read_splines(self.folder / "again.xml").GetBlock(0), sphere())

    def test_what_is_read_is_geometry(self):
        path = self.folder / "model.xml"
        footpoint.write_splines([square(), sphere()], path)
        r = footpoint.invert([[0.5, 0.5, 0.1], [0, 0, 1.5]], footpoint.read_splines(path))
        equal(r.face, [0, 1])
        np.testing.assert_allclose(r.distance, [0.1, 0.5], rtol=1e-12)

    def test_trimmed_faces(self):
        corners = np.array([(0.1, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)])
        face = footpoint.trimmed_face(square(), [corners, [corners[::-1] / 2 + 0.25]])
        path = self.folder / "face.json"
        footpoint.write_splines(face, path)
        compare(footpoint.read_splines(path).GetBlock(0), face)
        with self.assertRaisesRegex(ValueError, "spline 0: it is a trimmed face"):
            footpoint.write_splines(face, self.folder / "face.g2")

    def test_format(self):
        path = self.folder / "noname"
        with self.assertRaisesRegex(ValueError, "the extension '' is that of no format"):
            footpoint.write_splines(sphere(), path)
        footpoint.write_splines(sphere(), path, format="GoTools")
        self.assertTrue(path.read_text().startswith("200 1 0 0\n"))
        compare(footpoint.read_splines(path, format=2).GetBlock(0), sphere())
        with self.assertRaisesRegex(ValueError, "it is no JSON"):
            footpoint.read_splines(path, format="geomdl")
        with self.assertRaisesRegex(ValueError, "format = 'step' is none of .*GoTools"):
            footpoint.read_splines(path, format="step")

    def test_errors_and_warnings(self):
        path = self.folder / "bad.g2"
        with self.assertRaisesRegex(ValueError, "bad.g2: it cannot be opened"):
            footpoint.read_splines(path)
        path.write_text("100 1 0 0\n3 0\n2 2\n0 0 1 x\n")
        with self.assertRaisesRegex(ValueError, "bad.g2: line 4: expected knot 3, found 'x'"):
            footpoint.read_splines(path)
        footpoint.write_splines(sphere(), path)
        path.write_text("700 1 0 0\n1 2 3\n" + path.read_text())
        with self.assertWarnsRegex(RuntimeWarning, r"the SplineVolume \(class 700\) is left out"):
            self.assertEqual(footpoint.read_splines(path).GetNumberOfBlocks(), 1)
        net = sphere()
        net.GetFieldData().AddArray(to_vtk(np.array([1.0]), "LengthUnit", copy=True))
        with self.assertWarnsRegex(RuntimeWarning, "left out: LengthUnit"):
            footpoint.write_splines(net, path)
        with self.assertRaisesRegex(TypeError, "geometry is a int"):
            footpoint.write_splines(7, path)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            footpoint.write_splines(sphere(), path)


if __name__ == "__main__":
    unittest.main()
