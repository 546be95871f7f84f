# SPDX-License-Identifier: BSD-3-Clause
"""Real files of G+Smo, against copies of the same models that other software made; through every
format and through VTK's own files without a bit changed.
"""

from pathlib import Path
import tempfile
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLMultiBlockDataWriter

import footpoint
from shared_data import folder, make_curve, make_face, records

DATA = folder()
FILES = ["splines/egg.xml", "splines/teapot.xml", "curves/rotor_bdry.xml",
         "curves/butterfly_bdry.xml", "curves/curve_boundary.xml"]

equal = np.testing.assert_array_equal


def numbers(net):
    """All numbers of a net; without weights ones."""
    weights = net.GetPointData().GetArray("RationalWeights")
    points = vtk_to_numpy(net.GetPoints().GetData())
    fields = [net.GetFieldData().GetArray(name) for name in ("KnotsU", "KnotsV", "Degree")]
    return [
        points,
        np.ones(len(points)) if weights is None else vtk_to_numpy(weights),
        *(vtk_to_numpy(field) for field in fields if field is not None),
    ]


def read(path):
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*how they are joined is left out")
        return footpoint.read_splines(path)


class SharedFiles(unittest.TestCase):
    def compare(self, blocks, nets, where):
        self.assertEqual(blocks.GetNumberOfBlocks(), len(nets), where)
        for i, net in enumerate(nets):
            self.assertEqual(blocks.GetBlock(i).GetDimensions(), net.GetDimensions())
            found, expected = numbers(blocks.GetBlock(i)), numbers(net)
            self.assertEqual(len(found), len(expected))
            for one, other in zip(found, expected):
                equal(one, other, f"{where}, spline {i}")

    def test_copies(self):
        """The same splines as in the JSON copies, number for number."""
        count = 0
        for name in FILES:
            copy = DATA / "json" / f"gismo__{Path(name).name}.jsonl"
            nets = [make_face(r) for r in records(copy, "face")]
            nets += [make_curve(r) for r in records(copy, "edge")]
            self.compare(read(DATA / name), nets, name)
            count += len(nets)
        self.assertEqual(count, 45)

    def test_round_trips(self):
        with tempfile.TemporaryDirectory() as scratch:
            for name in FILES:
                model = read(DATA / name)
                nets = [model.GetBlock(i) for i in range(model.GetNumberOfBlocks())]
                for extension in ("xml", "g2", "json"):
                    path = Path(scratch) / f"copy.{extension}"
                    footpoint.write_splines(model, path)
                    self.compare(footpoint.read_splines(path), nets, f"{name} as {extension}")
                writer = vtkXMLMultiBlockDataWriter()
                writer.SetFileName(str(Path(scratch) / "copy.vtm"))
                writer.SetInputData(model)
                self.assertEqual(writer.Write(), 1)
                reader = vtkXMLMultiBlockDataReader()
                reader.SetFileName(str(Path(scratch) / "copy.vtm"))
                reader.Update()
                self.compare(reader.GetOutput(), nets, f"{name} as vtm")

    def test_points_come_back(self):
        """Points of the teapot, as read, are found on it again."""
        model = read(DATA / "splines/teapot.xml")
        generator = np.random.default_rng(4)
        faces = generator.integers(32, size=200)
        points = footpoint.evaluate(model, generator.random((200, 2)), faces)
        r = footpoint.invert(points, model)
        self.assertLessEqual(r.distance.max(), 1e-13 * 7)


if __name__ == "__main__":
    unittest.main()
