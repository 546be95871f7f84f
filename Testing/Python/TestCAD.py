# SPDX-License-Identifier: BSD-3-Clause
"""CAD files in Python: the exact faces go into `invert`, errors are Python's own."""

import gzip
import inspect
import os
from pathlib import Path
import shutil
import unittest
import warnings

import numpy as np

import footpoint
from footpoint._options import option_names
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

FILES = Path(os.environ.get("FOOTPOINT_SHARED_DATA", "")) / "cad"
OUTPUT = Path(os.environ.get("FOOTPOINT_TEST_OUTPUT", "."))


def surface_of(block):
    """The surface's net of a face, trimmed or not."""
    return block.GetBlock(0) if isinstance(block, vtkMultiBlockDataSet) else block


class WithoutOpenCascade(unittest.TestCase):
    @unittest.skipIf(hasattr(footpoint, "vtkCADReader"), "built with Open CASCADE")
    def test_import_error(self):
        with self.assertRaisesRegex(ImportError, "without Open CASCADE"):
            footpoint.read_cad("any.step")


@unittest.skipUnless(hasattr(footpoint, "vtkCADReader"), "built without Open CASCADE")
class Errors(unittest.TestCase):
    def test_no_file(self):
        with self.assertRaises(FileNotFoundError) as caught:
            footpoint.read_cad("there_is_none.step")
        self.assertEqual(caught.exception.filename, "there_is_none.step")

    def test_no_cad_file(self):
        path = OUTPUT / "no_cad.step"
        path.write_text("some text\n", encoding="utf-8")
        with self.assertRaisesRegex(ValueError, "it is neither STEP"):
            footpoint.read_cad(path)

    def test_options(self):
        path = OUTPUT / "no_cad.step"
        path.write_text("some text\n", encoding="utf-8")
        with self.assertRaisesRegex(TypeError, "no option 'length_units'"):
            footpoint.read_cad(path, length_units="mm")
        with self.assertRaisesRegex(ValueError, "LengthUnit 'furlong' is none of"):
            footpoint.read_cad(path, length_unit="furlong")
        with self.assertRaisesRegex(ValueError, "empty sequence"):
            footpoint.read_cad(path, faces=[])

    def test_documentation(self):
        text = inspect.getdoc(footpoint.read_cad) + inspect.getdoc(footpoint.read_cad_parts)
        for option in option_names(footpoint.vtkCADReader).keys() - {"file_name"}:  # is path
            self.assertIn(option, text)


@unittest.skipUnless(hasattr(footpoint, "vtkCADReader"), "built without Open CASCADE")
@unittest.skipUnless(FILES.is_dir(), "FOOTPOINT_SHARED_DATA holds no folder cad")
class RealFiles(unittest.TestCase):
    def test_invert_on_a_ship(self):
        model = footpoint.read_cad(FILES / "wigley.iges")
        self.assertEqual(model.GetNumberOfBlocks(), 1)
        net = surface_of(model.GetBlock(0))
        points = footpoint.evaluate(net, [[0.3, 0.4], [0.7, 0.2]])
        result = footpoint.invert(points, net)
        size = np.linalg.norm(np.diff(np.reshape(net.GetBounds(), (3, 2)), axis=1))
        self.assertLess(result.distance.max(), 1e-12 * size)

    def test_parts(self):
        parts = footpoint.read_cad_parts(FILES / "ubend2.stp", angular_deflection=30.0)
        self.assertEqual(parts.model.GetNumberOfBlocks(), 4)
        self.assertEqual(parts.edges.GetNumberOfBlocks(), 12)
        self.assertGreater(parts.mesh.GetNumberOfCells(), 10)
        self.assertEqual(parts.mesh.GetCellData().GetArray("FaceId").GetRange(), (0.0, 3.0))

    def test_faces_and_units(self):
        model = footpoint.read_cad(FILES / "goteborg.step", faces=[1], length_unit="mm")
        self.assertIsNone(model.GetBlock(0))
        metres = footpoint.read_cad(FILES / "goteborg.step")
        ratio = (np.array(surface_of(model.GetBlock(1)).GetBounds())
                 / np.array(surface_of(metres.GetBlock(1)).GetBounds()))
        self.assertLess(np.nanmax(np.abs(ratio - 1000.0)), 1e-9)

    def test_gzip(self):
        packed = OUTPUT / "wing.iges.gz"
        with open(FILES / "wing.iges", "rb") as source, gzip.open(packed, "wb") as target:
            shutil.copyfileobj(source, target)
        self.assertEqual(footpoint.read_cad(packed).GetNumberOfBlocks(), 4)

    def test_no_warnings(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(footpoint.read_cad(FILES / "dm1-id-214.stp").GetNumberOfBlocks(), 48)


if __name__ == "__main__":
    unittest.main()
