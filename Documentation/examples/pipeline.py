# SPDX-License-Identifier: BSD-3-Clause
"""A VTK pipeline in Python: points of a scan against a surface in a file.

    pipeline.py <output folder>
"""

import pathlib
import sys

from footpoint import vtkPointInversionFilter
from vtkmodules.vtkFiltersCore import vtkThresholdPoints
from vtkmodules.vtkFiltersSources import vtkPointSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLStructuredGridReader

surface = vtkXMLStructuredGridReader()
surface.SetFileName(str(pathlib.Path(__file__).resolve().parents[2] / "Data" / "blade.vts"))

points = vtkPointSource()  # stands for the reader of a scan
points.SetCenter(0.0, 0.0, 75.0)
points.SetRadius(80.0)
points.SetNumberOfPoints(2000)

inversion = vtkPointInversionFilter()
inversion.SetInputConnection(points.GetOutputPort())
inversion.SetSourceConnection(surface.GetOutputPort())
inversion.SetMaximumDistance(20.0)  # farther points are no part of the scan
inversion.SetDeviationTolerance(5.0)

found = vtkThresholdPoints()  # Status 3 is BeyondMaximumDistance
found.SetInputConnection(inversion.GetOutputPort())
found.SetInputArrayToProcess(0, 0, 0, 0, "Status")  # 0: point data
found.ThresholdByLower(2)

writer = vtkXMLPolyDataWriter()
writer.SetInputConnection(found.GetOutputPort())
writer.SetFileName(str(pathlib.Path(sys.argv[1]) / "near_points.vtp"))
writer.Write()

statistics = inversion.GetOutputDataObject(0).GetFieldData()
count = int(statistics.GetArray("DistanceCount").GetValue(0))
print(f"{count} points within 20 mm, RMS {statistics.GetArray('DistanceRMS').GetValue(0):.3f} mm,",
      f"{100 * statistics.GetArray('OutOfToleranceFraction').GetValue(0):.0f} % beyond 5 mm")
assert count == found.GetOutput().GetNumberOfPoints() > 0
