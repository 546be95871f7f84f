# SPDX-License-Identifier: BSD-3-Clause
"""The proxies of spline files: by name, by the dialogs' factories of readers and writers, and in a
pipeline.
"""

import os
from pathlib import Path
import unittest

from paraview import servermanager, simple

import footpoint

OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"])


def surface():
    return footpoint.nurbs_surface(
        [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1 / 3]]],
        [0, 0, 1, 1], [0, 0, 2, 2], weights=[[1, 2], [3, 4]])


def producer(data):
    proxy = simple.TrivialProducer()
    proxy.GetClientSideObject().SetOutput(data)
    return proxy


class SplineFiles(unittest.TestCase):
    def check(self, reader, count):
        reader.UpdatePipeline()
        blocks = servermanager.Fetch(reader, 0)
        self.assertEqual(blocks.GetNumberOfBlocks(), count)
        net, expected = blocks.GetBlock(0), surface()
        self.assertEqual(net.GetDimensions(), (2, 2, 1))
        for i in range(4):
            self.assertEqual(net.GetPoint(i), expected.GetPoint(i))
        self.assertEqual(net.GetFieldData().GetArray("KnotsV").GetRange(), (0, 2))

    def test_written_and_read(self):
        for name, writes in (("nets.g2", 2), ("nets.xml", 1), ("nets.json", 3)):
            path = str(OUTPUT / f"proxy_{name}")
            footpoint.write_splines([surface()] * writes, path)
            self.check(simple.SplineFileReader(FileName=path), writes)
            # ParaView gives .xml to its CityGML reader first; the others have no second reader.
            if not path.endswith(".xml"):
                self.check(simple.OpenDataFile(path), writes)

    def test_save_data(self):
        for data in (surface(), footpoint.model([surface(), surface()])):
            path = str(OUTPUT / "proxy_saved.g2")
            simple.SaveData(path, producer(data))
            self.check(simple.OpenDataFile(path), 1 if data.IsA("vtkStructuredGrid") else 2)

    def test_format(self):
        path = str(OUTPUT / "proxy_splines.txt")
        writer = servermanager.writers.SplineFileWriter(
            Input=producer(surface()), FileName=path, Format="Geomdl")
        writer.UpdatePipeline()
        reader = simple.SplineFileReader(FileName=path, Format="Geomdl")
        self.check(reader, 1)
        for proxy in (reader, writer):
            for value in proxy.GetProperty("Format").Available:
                proxy.Format = value
                proxy.UpdateVTKObjects()
                self.assertEqual(proxy.GetClientSideObject().GetFormatAsString(), value)

    def test_pipeline(self):
        path = str(OUTPUT / "proxy_model.xml")
        footpoint.write_splines([surface()], path)
        reader = simple.SplineFileReader(FileName=path)
        sphere = simple.Sphere()
        inversion = simple.PointInversion(Input=sphere, Source=reader)
        inversion.UpdatePipeline()
        self.assertTrue(inversion.PointData.keys().count("Distance"))

    def test_nets_are_shown_as_lines(self):
        path = str(OUTPUT / "proxy_shown.g2")
        footpoint.write_splines([surface()], path)
        view = simple.CreateRenderView()
        self.addCleanup(simple.Delete, view)  # its window, before the X connection closes
        shown = simple.Show(simple.SplineFileReader(FileName=path), view)
        self.assertEqual(shown.Representation, "Wireframe")


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    unittest.main()
