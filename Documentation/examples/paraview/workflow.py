# SPDX-License-Identifier: BSD-3-Clause
"""The steps of the ParaView guide by script: deviations, what is out of tolerance, statistics,
and a patch between four lines.

    FOOTPOINT_PLUGIN=<path of Footpoint.so> pvpython workflow.py <output folder>
"""

import os
import pathlib
import sys

from paraview import servermanager, simple

DATA = pathlib.Path(__file__).resolve().parents[3] / "Data"
simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=globals())

blade = simple.XMLStructuredGridReader(FileName=[str(DATA / "blade.vts")])
scan = simple.XMLPolyDataReader(FileName=[str(DATA / "scan.vtp")])
deviation = PointInversion(Input=scan, Source=blade, DeviationTolerance=0.05)

# Show colours by SignedDistance, 0 in the middle.
view = simple.CreateRenderView(ViewSize=[600, 400])
simple.Show(deviation, view)
simple.SaveScreenshot(str(pathlib.Path(sys.argv[1]) / "paraview_workflow.png"), view)

# Points whose foot is proved to be the nearest, and of those the ones out of tolerance.
certified = simple.Threshold(Input=deviation, Scalars=["POINTS", "Status"],
                             LowerThreshold=0, UpperThreshold=0)
outside = simple.Threshold(Input=certified, Scalars=["POINTS", "Distance"],
                           LowerThreshold=0.05, ThresholdMethod="Above Upper Threshold",
                           UpperThreshold=0.05)
outside.UpdatePipeline()
count = outside.GetDataInformation().GetNumberOfPoints()

# Statistics are field data of the points; those of each face are a table, output 2.
deviation.UpdatePipeline()
statistics = {name: deviation.FieldData[name].GetRange()[0]
              for name in ("DistanceCount", "DistanceRMS", "OutOfToleranceFraction")}
print(f"RMS {statistics['DistanceRMS']:.4f} mm, {count} of {statistics['DistanceCount']:.0f} out")
assert count == round(statistics["OutOfToleranceFraction"] * statistics["DistanceCount"]) > 0
faces = servermanager.Fetch(deviation, 0, idx=2)
assert faces.GetNumberOfRows() == 1

# A Coons patch between four lines, in any order and direction.
corners = [[0, 0, 0], [2, 0, 0], [2, 1, 1], [0, 1, 0]]
sides = [simple.Line(Point1=a, Point2=b) for a, b in zip(corners, corners[1:] + corners[:1])]
patch = CoonsPatch(Input=sides, Resolution=[9, 7])
patch.UpdatePipeline()
assert patch.GetDataInformation(0).GetNumberOfPoints() == 9 * 7
simple.Delete(view)  # its window, before the X connection closes
