# SPDX-License-Identifier: BSD-3-Clause
"""The proxy CADReader: files open with it, and its three outputs arrive."""

import gzip
import os
from pathlib import Path
import sys
import unittest

from paraview import servermanager, simple

import footpoint

if not hasattr(footpoint, "vtkCADReader"):
    print("skipped: built without Open CASCADE")
    sys.exit(125)

FILE = Path(os.environ["FOOTPOINT_SHARED_DATA"]) / "cad" / "ubend2.stp"
OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"])


class CADReader(unittest.TestCase):
    @unittest.skipUnless(FILE.exists(), "FOOTPOINT_SHARED_DATA holds no folder cad")
    def test_open(self):
        packed = OUTPUT / "ubend2.stp.gz"
        packed.write_bytes(gzip.compress(FILE.read_bytes()))
        for path in (FILE, packed):
            reader = simple.OpenDataFile(str(path))
            self.assertEqual(reader.GetXMLName(), "CADReader", path.name)
            reader.UpdatePipeline()
            self.assertGreater(servermanager.Fetch(reader, idx=0).GetNumberOfCells(), 10)
            self.assertEqual(servermanager.Fetch(reader, idx=1).GetNumberOfBlocks(), 4)
            self.assertEqual(servermanager.Fetch(reader, idx=2).GetNumberOfBlocks(), 12)

    @unittest.skipUnless(FILE.exists(), "FOOTPOINT_SHARED_DATA holds no folder cad")
    def test_options_arrive(self):
        reader = simple.CADReader(FileName=str(FILE), Faces="1", GenerateMesh=0)
        reader.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(reader, idx=0).GetNumberOfCells(), 0)
        model = servermanager.Fetch(reader, idx=1)
        self.assertIsNone(model.GetBlock(0))
        self.assertIsNotNone(model.GetBlock(1))


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    unittest.main()
