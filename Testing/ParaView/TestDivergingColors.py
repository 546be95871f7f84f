# SPDX-License-Identifier: BSD-3-Clause
"""The first picture of Point Inversion: signed distances in a diverging map with 0 in its middle."""

import json
import os
from pathlib import Path
import unittest

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLStructuredGridWriter

import footpoint

DATA = Path(__file__).resolve().parents[2] / "Data"
OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"])


def ends(colors):
    """The range of a colour map, and the colour and value of its middle point."""
    points = np.reshape(list(colors.RGBPoints), (-1, 4))
    return points[0, 0], points[-1, 0], points[len(points) // 2]


class FirstPicture(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        self.blade = simple.XMLStructuredGridReader(FileName=[str(DATA / "blade.vts")])
        self.scan = simple.XMLPolyDataReader(FileName=[str(DATA / "scan.vtp")])
        self.moved = simple.Transform(Input=self.scan, Transform="Transform")
        self.inversion = simple.PointInversion(Input=self.moved, Source=self.blade)
        self.view = simple.CreateRenderView(ViewSize=[300, 200])
        self.addCleanup(simple.Delete, self.view)  # its window, before the X connection closes

    def largest(self, name="SignedDistance"):
        data = servermanager.Fetch(self.inversion, 0, idx=0)
        return np.abs(vtk_to_numpy(data.GetPointData().GetArray(name))).max()

    def show(self, name="SignedDistance"):
        display = simple.Show(self.inversion, self.view)
        simple.Render(self.view)
        self.assertEqual(list(display.ColorArrayName), ["POINTS", name])
        return display.LookupTable

    def setting(self, values):
        """As if read from the user's file of settings, for one test."""
        settings = servermanager.vtkSMSettings.GetInstance()
        self.addCleanup(settings.ClearAllSettings)
        self.assertTrue(settings.AddCollectionFromString(json.dumps(values), 10.0))

    def test_zero_is_the_middle(self):
        colors = self.show()
        largest = self.largest()
        self.assertGreater(largest, 0.05)
        low, high, middle = ends(colors)
        self.assertEqual((low, high), (-largest, largest))
        self.assertEqual(middle[0], 0.0)
        np.testing.assert_allclose(middle[1:], 0.865)  # grey between blue and red
        self.assertEqual(colors.ColorSpace, "Diverging")
        opacities = list(simple.GetOpacityTransferFunction("SignedDistance").Points)
        self.assertEqual((opacities[0], opacities[-4]), (-largest, largest))

    def test_also_when_updated_before(self):
        self.inversion.UpdatePipeline()
        low, high, _ = ends(self.show())
        self.assertEqual((low, high), (-self.largest(), self.largest()))

    def test_whatever_the_default_map(self):
        self.setting({"lookup_tables": {"PVLookupTable": {"ColorSpace": 2}}})
        other = simple.GetColorTransferFunction("Elsewhere")
        self.assertEqual(other.ColorSpace, "Lab")
        self.assertEqual(self.show().ColorSpace, "Diverging")

    def test_growth_is_symmetric(self):
        colors = self.show()
        first = self.largest()
        self.moved.Transform.Translate = [0.0, 3.0, 0.0]
        simple.Render(self.view)
        self.assertGreater(self.largest(), 2 * first)
        self.assertEqual(ends(colors)[:2], (-self.largest(), self.largest()))
        grown = self.largest()
        self.moved.Transform.Translate = [0.0, 0.0, 0.0]
        simple.Render(self.view)
        self.assertEqual(ends(colors)[:2], (-grown, grown), "it does not shrink")

    def test_ranges_of_the_user_stay(self):
        colors = self.show()
        colors.RescaleTransferFunction(-0.01, 0.02)
        self.moved.Transform.Translate = [0.0, 3.0, 0.0]
        simple.Render(self.view)
        np.testing.assert_allclose(ends(colors)[:2], (-0.01, 0.02), rtol=1e-12)
        colors.RescaleTransferFunction(-0.01, 0.01)
        colors.AutomaticRescaleRangeMode = "Never"
        self.moved.Transform.Translate = [0.0, 4.0, 0.0]
        simple.Render(self.view)
        np.testing.assert_allclose(ends(colors)[:2], (-0.01, 0.01), rtol=1e-12)

    def test_map_that_was_there_before(self):
        colors = simple.GetColorTransferFunction("SignedDistance")
        colors.RescaleTransferFunction(0.0, 0.03)
        colors.AutomaticRescaleRangeMode = "Never"
        self.assertEqual(ends(self.show())[:2], (0.0, 0.03))

    def test_default_saved_by_the_user(self):
        """As "Save current colour map for arrays of this name" leaves it in the settings."""
        self.setting({"array_lookup_tables": {"SignedDistance": {"PVLookupTable": {
            "ColorSpace": 2, "AutomaticRescaleRangeMode": -1,
            "RGBPoints": [0.0, 0.0, 0.0, 0.0, 0.125, 1.0, 1.0, 1.0]}}}})
        colors = self.show()
        self.assertEqual(colors.ColorSpace, "Lab")
        self.assertEqual(ends(colors)[:2], (0.0, 0.125))

    def test_prefix(self):
        self.inversion.ArrayNamePrefix = "Before"
        low, high, _ = ends(self.show("BeforeSignedDistance"))
        largest = self.largest("BeforeSignedDistance")
        self.assertEqual((low, high), (-largest, largest))

    def test_without_the_array(self):
        """Curves have no side: their distances are coloured as ParaView colours anything."""
        path = OUTPUT / "colors_curve.vts"
        writer = vtkXMLStructuredGridWriter()
        writer.SetFileName(str(path))
        writer.SetInputData(footpoint.nurbs_curve([[0, 0, 0], [1, 1, 150]], [0, 0, 1, 1]))
        self.assertEqual(writer.Write(), 1)
        self.inversion.Source = simple.XMLStructuredGridReader(FileName=[str(path)])
        low, high, _ = ends(self.show("Distance"))
        self.assertGreaterEqual(low, 0.0)
        self.assertAlmostEqual(high, self.largest("Distance"))
        group, name = "lookup_tables", "SignedDistance.PVLookupTable"
        manager = servermanager.ProxyManager()
        self.assertNotIn(name, [key[0] for key in manager.GetProxiesInGroup(group)])

    def test_no_distance(self):
        """Where no point has a distance there is nothing to centre, and nothing fails."""
        self.inversion.MaximumDistance = 0.0  # Status 3, NaN
        self.assertEqual(self.show().ScalarRangeInitialized, 0)


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    unittest.main()
