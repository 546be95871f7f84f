# SPDX-License-Identifier: BSD-3-Clause
"""Deviations in ParaView, without its window: a picture of the scan coloured by signed distance.

    FOOTPOINT_PLUGIN=<path of Footpoint.so> pvpython deviation.py <output folder>
"""

import os
import pathlib
import sys

from paraview import simple

DATA = pathlib.Path(__file__).resolve().parents[3] / "Data"
simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False)

blade = simple.XMLStructuredGridReader(FileName=[str(DATA / "blade.vts")])
scan = simple.XMLPolyDataReader(FileName=[str(DATA / "scan.vtp")])
deviation = simple.PointInversion(Input=scan, Source=blade)
deviation.DeviationTolerance = 0.05

view = simple.CreateRenderView(
    ViewSize=[1000, 600], Background=[1, 1, 1], UseColorPaletteForBackground=0)
view.OrientationAxesVisibility = 0
points = simple.Show(deviation, view)
points.PointSize = 6
simple.ColorBy(points, ("POINTS", "SignedDistance"))
colours = simple.GetColorTransferFunction("SignedDistance")
colours.RescaleTransferFunction(-0.1, 0.1)
legend = simple.GetScalarBar(colours, view)
legend.Title, legend.ComponentTitle = "Deviation [mm]", ""
legend.RangeLabelFormat = legend.LabelFormat = "%+.2f"
legend.TitleColor = legend.LabelColor = [0.1, 0.1, 0.1]
legend.WindowLocation = "Upper Right Corner"
points.SetScalarBarVisibility(view, True)
view.CameraViewUp = [0.79, 0.62, 0]  # along the chord
view.CameraPosition = [-250, 315, 35]  # over the suction side
view.CameraFocalPoint = [0, 0, 75]
view.ResetCamera(True)
simple.SaveScreenshot(str(pathlib.Path(sys.argv[1]) / "paraview_deviation.png"), view)

deviation.UpdatePipeline()
statistics = deviation.FieldData
assert statistics["DistanceCount"].GetRange() == (2000.0, 2000.0)
print(f"RMS {statistics['DistanceRMS'].GetRange()[0]:.4f} mm")
