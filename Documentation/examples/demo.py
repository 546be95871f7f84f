# SPDX-License-Identifier: BSD-3-Clause
"""Inspects a simulated scan of a blade: deviations from the exact surface, a picture and a report.

    demo.py <output folder> [<path of a small picture>]

Writes deviation.png, deviation.vtp and report.md. Run it with ./demo.sh. Ends with an error if the
injected damage is not found again, so that it is a test as well.
"""

import pathlib
import sys
import time

import footpoint
import numpy as np
from vtkmodules.vtkIOXML import vtkXMLStructuredGridReader

from inspection.analysis import inspect
from inspection.output import figures, largest_gain_of_samples, write_points, write_report
from inspection.picture import make_picture, write_png, write_small_png
from inspection.scan import DENT_DEPTH, simulate

BLADE = pathlib.Path(__file__).resolve().parents[2] / "Data" / "blade.vts"
NUMBER_OF_POINTS = 100_000
TOLERANCE = 0.05  # mm


def read_surface(path):
    """A spline surface is a vtkStructuredGrid of control points: VTK's own reader does."""
    reader = vtkXMLStructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def main(folder, small_picture=None):
    folder.mkdir(parents=True, exist_ok=True)
    blade = read_surface(BLADE)
    print("Surface: {} x {} control points from {}".format(*blade.GetDimensions()[:2], BLADE.name))

    scan = simulate(blade, NUMBER_OF_POINTS)
    print(f"Scan: {len(scan.points):,} points; noise, {scan.is_outlier.sum()} outliers, a band "
          f"without points and a dent of {DENT_DEPTH} mm")

    start = time.perf_counter()
    result = footpoint.invert(scan.points, blade, deviation_tolerance=TOLERANCE)
    seconds = time.perf_counter() - start
    print(f"Point inversion: {seconds:.2f} s, {1e6 * seconds / len(scan.points):.1f} µs a point")

    inspection = inspect(scan.points, result, TOLERANCE)
    gain = largest_gain_of_samples(blade, scan.points, result.distance)
    if gain > 1e-10:
        sys.exit(f"demo: a sample of the surface is {gain} mm nearer than a foot")
    defect = inspection.defect
    print(f"Outliers found: {inspection.outliers.sum()}")
    print("Damage found:", "none" if defect is None else
          f"{defect.height:+.3f} mm at ({', '.join(f'{x:.2f}' for x in defect.position)}) mm")

    write_points(folder / "deviation.vtp", inspection)
    write_report(folder / "report.md", inspection, scan, seconds)
    window = make_picture(
        inspection, blade, "Blade: deviation of the scanned points from the nominal surface",
        f"{len(scan.points):,} points of a simulated optical scan \u00b7 nominal surface: bicubic "
        f"B-spline \u00b7 tolerance \u00b1{TOLERANCE} mm", figures(inspection))
    write_png(window, folder / "deviation.png")
    if small_picture is not None:
        write_small_png(window, small_picture, 960, 200)

    # === Was the truth found?
    if not np.isin(result.status, (footpoint.Status.CERTIFIED, footpoint.Status.CONVERGED)).all():
        sys.exit("demo: points without a foot")
    if (inspection.outliers & ~scan.is_outlier).sum() > 10:
        sys.exit("demo: good points were taken for outliers")
    if (defect is None or np.linalg.norm(defect.position - scan.dent_centre) > 0.5
            or abs(defect.height + DENT_DEPTH) > 0.01):
        sys.exit("demo: the injected dent was not found")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(*map(pathlib.Path, sys.argv[1:]))
