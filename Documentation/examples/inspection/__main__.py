# SPDX-License-Identifier: BSD-3-Clause
"""Inspects a scan of a part against its CAD file: deviations from the exact surfaces, a picture, a
report in HTML, and files for ParaView and spreadsheets. Run it by ./demo.sh.

Without a scan one is simulated: a bent part with noise, outliers and patches that were not seen.
The program then ends with an error if the bend is not found again. Without a CAD file the part is a
bearing bracket that comes with Debian's Open CASCADE.
"""

import argparse
import pathlib
import sys
import time

import footpoint
import numpy as np

from .analysis import inspect
from .lengths import lengths_for, round_up
from .output import (
    figures, write_faces_csv, write_points, write_points_csv, write_scan, write_state, write_vtp)
from .part import METRES, InputError, read_part
from .picture import eyes, make_picture, write_png, write_small_png
from .report import verdict, write_report
from .scan import simulate
from .scan_files import check_size, read_scan

BRACKET = pathlib.Path("/usr/share/opencascade/data/iges/bearing.iges")
NUMBER_OF_POINTS = 100_000


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="./demo.sh", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cad", nargs="?", metavar="CAD", help="STEP, IGES or BREP, also .gz")
    parser.add_argument("scan", nargs="?", metavar="SCAN",
                        help=".ply, .stl, .vtp, .csv, .xyz or .txt")
    parser.add_argument("--output", default="demo-output", metavar="FOLDER",
                        help="where results go (default: demo-output)")
    parser.add_argument("--unit", choices=METRES, metavar="UNIT",
                        help=f"of the scan and the results: {', '.join(METRES)} (default: that of "
                        "the CAD file, which is converted)")
    parser.add_argument("--cad-unit", choices=METRES, metavar="UNIT",
                        help="of the numbers in the CAD file, if it is not what the file says")
    parser.add_argument("--tolerance", type=float, metavar="LENGTH",
                        help="deviation that is allowed (default: about a thousandth of the size)")
    parser.add_argument("--points-csv", action="store_true",
                        help="write points.csv too, a row for every point")
    parser.add_argument("--small-picture", metavar="PNG", help="write the picture small as well")
    options = parser.parse_args(arguments)
    if options.tolerance is not None and not 0.0 < options.tolerance < np.inf:
        parser.error(f"--tolerance {options.tolerance} is not positive")
    if options.cad is None:
        options.cad = BRACKET
        if not BRACKET.is_file():
            raise InputError(f"there is no {BRACKET}; Debian's package occt-misc brings it")
        # The file says mm, but holds a part of a tenth of that; it is drawn in metres.
        options.cad_unit, options.unit = options.cad_unit or "m", options.unit or "mm"
    return options


def run(options):
    part = read_part(options.cad, options.unit, options.cad_unit)
    doubt = ("" if part.file_unit == part.declared_unit else
             f", taken in {part.file_unit} although it says {part.declared_unit}")
    print(f"Part: {len(part.names)} faces, {part.size:.4g} {part.unit} from corner to corner, from "
          f"{part.path.name}{doubt}")
    simulated = None
    if options.scan is None:
        simulated = simulate(part, NUMBER_OF_POINTS)
        points = simulated.points
        bend = np.linalg.norm(simulated.shift)
        print(f"Simulated scan: {len(points):,} points; noise, {simulated.is_outlier.sum()} "
              f"outliers, patches without points, and one end bent by {bend:.3g} {part.unit}")
    else:
        points = read_scan(options.scan)
        print(f"Scan: {len(points):,} points from {options.scan}")
        check_size(points, part)
    tolerance = options.tolerance or round_up(6e-4 * part.size, (1.0, 2.0, 5.0, 10.0))

    # === Measure
    start = time.perf_counter()
    result = footpoint.invert(points, part.model, deviation_tolerance=tolerance)
    seconds = time.perf_counter() - start
    print(f"Point inversion: {seconds:.2f} s, {1e6 * seconds / len(points):.1f} µs a point; "
          f"{np.sum(result.status == footpoint.Status.CERTIFIED):,} feet proved to be nearest")
    inspection = inspect(points, result, tolerance, part.area)
    good = result.signed_distance[inspection.good]
    lengths = lengths_for(part.unit, tolerance, good)
    print(verdict(part, inspection, lengths)[1])

    # === Write
    folder = pathlib.Path(options.output)
    folder.mkdir(parents=True, exist_ok=True)
    if simulated is not None:
        write_scan(folder / "scan.ply", points)
    write_vtp(folder / "part.vtp", part.mesh)
    write_points(folder / "deviation.vtp", inspection)
    write_faces_csv(folder / "faces.csv", part, inspection)
    if options.points_csv:
        write_points_csv(folder / "points.csv", inspection)
    write_state(folder / "paraview_state.py", part, lengths, eyes(part, inspection)[0])
    window = make_picture(
        part, inspection, lengths, f"{part.path.name}: deviation of the scan from the CAD model",
        f"{len(points):,} points of {'a simulated' if simulated else 'the'} scan \u00b7 "
        f"{len(part.names)} exact trimmed faces \u00b7 tolerance \u00b1{tolerance:g} {part.unit}",
        figures(inspection, lengths, seconds))
    write_png(window, folder / "deviation.png")
    if options.small_picture:
        write_small_png(window, pathlib.Path(options.small_picture), 960, 200)
    write_report(folder / "report.html", part, inspection, lengths, seconds,
                 folder / "deviation.png", simulated)
    print(f"Written into {folder}/: report.html, deviation.png, deviation.vtp, faces.csv, "
          "part.vtp, paraview_state.py" + (", points.csv" if options.points_csv else "")
          + (", scan.ply" if simulated else ""))
    if simulated is not None:
        check(part, inspection, simulated)


def check(part, inspection, scan):
    """Was the truth found?"""
    if (inspection.outliers & ~scan.is_outlier).mean() > 1e-3:
        sys.exit("demo: good points were taken for outliers")
    place, deviation = scan.feet[scan.worst], scan.deviations[scan.worst]
    if not any(np.linalg.norm(region.position - place) < 0.1 * part.size
               and abs(region.height - deviation) < 5.0 * scan.noise
               for region in inspection.regions[:2]):
        sys.exit("demo: the bent end was not found")


if __name__ == "__main__":
    try:
        run(parse(sys.argv[1:]))
    except InputError as error:
        sys.exit(f"demo: {error}")
