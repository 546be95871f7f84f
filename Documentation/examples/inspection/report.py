# SPDX-License-Identifier: BSD-3-Clause
"""The report of an inspection: one HTML file, with the picture in it."""

import base64
import os
import platform
from html import escape

import footpoint
import numpy as np
from vtkmodules.vtkCommonCore import vtkVersion

from .analysis import face_rows, statistics
from .output import FIGURES, as_text, counts

WORST_FACES = 12

STYLE = """
body { font: 15px/1.45 'Liberation Sans', Arial, sans-serif; color: #21262e; max-width: 1100px;
  margin: 2em auto; padding: 0 1em }
h1 { font-size: 26px; margin-bottom: 0 } h2 { font-size: 19px; margin: 1.6em 0 0.4em }
p.verdict { font-size: 17px; border-left: 5px solid; padding: 0.4em 0.8em; margin: 1em 0 }
p.bad { border-color: #b8331a; background: #fbeeeb }
p.good { border-color: #2c7a3f; background: #edf6ef }
table { border-collapse: collapse; margin: 0.4em 0 } th { text-align: left; font-weight: bold }
td, th { padding: 3px 14px 3px 0; border-bottom: 1px solid #dee0e6; vertical-align: top }
td.n, th.n { text-align: right; white-space: nowrap } .bar { display: inline-block; height: 10px }
img { width: 100%; border: 1px solid #dee0e6 } p.note { color: #666d78 }
"""


def table(header, rows, numbers):
    """An HTML table; numbers: the columns that are right-aligned. Texts are escaped."""
    def line(cells, tag):
        return "<tr>" + "".join(
            f"<{tag}{' class=n' if i in numbers else ''}>{escape(str(cell))}</{tag}>"
            for i, cell in enumerate(cells)) + "</tr>"

    lines = [line(header, "th")] if header else []
    return "<table>\n" + "\n".join(lines + [line(row, "td") for row in rows]) + "\n</table>"


def face_title(part, face):
    return f"{face} {part.names[face]}".strip()


def region_text(region, lengths):
    """What a region is, in words."""
    if region.motion.explains:
        shift = np.linalg.norm(region.motion.shift)
        direction = ", ".join(f"{x + 0.0:.2f}" for x in (region.motion.shift / shift).round(2))
        return (f"moved by {lengths.text(shift, 1)} along ({direction}), tilted by "
                f"{region.motion.tilt:.1f}°").replace("-", "\u2212")
    return "raised" if region.height > 0.0 else "dented"


def verdict(part, inspection, lengths):
    """The first sentence: (whether all is well, text)."""
    fraction = np.mean(
        np.abs(inspection.result.signed_distance[inspection.good]) > inspection.tolerance)
    if not inspection.regions:
        return True, (f"Within tolerance: no region deviates by more than "
                      f"±{lengths.text(inspection.tolerance, 2)}.")
    worst = inspection.regions[0]
    return False, (
        f"Out of tolerance: {fraction:.1%} of the points, in {len(inspection.regions)} "
        f"{'region' if len(inspection.regions) == 1 else 'regions'}. The worst deviates by "
        f"{lengths.signed(worst.height, 1)} at {lengths.point(worst.position)} on face "
        f"{face_title(part, worst.faces[0])}: {region_text(worst, lengths)}.")


def regions_section(part, inspection, lengths, scan):
    rows = [(i, lengths.signed(r.height, 1), lengths.point(r.position), f"{r.points:,}",
             ", ".join(face_title(part, face) for face in r.faces), region_text(r, lengths))
            for i, r in enumerate(inspection.regions[:WORST_FACES], 1)]
    text = table(("Region", "Deviation", "At", "Points", "Faces", "The part there is"), rows,
                 (0, 1, 3)) if rows else "<p>None.</p>"
    if scan is not None:
        text += ("<p>Injected into the simulated scan: the end at "
                 f"{lengths.point(scan.tip)} is bent, by {lengths.text(np.linalg.norm(scan.shift), 1)} there. Without noise the "
                 f"largest deviation would be {lengths.signed(scan.deviations[scan.worst], 1)}, at "
                 f"{lengths.point(scan.feet[scan.worst])}")
        if inspection.regions:
            way = np.linalg.norm(inspection.regions[0].position - scan.feet[scan.worst])
            text += f"; region 1 was found {lengths.text(way, 2)} from that place"
        text += ".</p>"
    return text


def faces_section(part, inspection, lengths):
    faces = face_rows(inspection, len(part.names))
    seen = [(i, row) for i, row in enumerate(faces) if row]
    bad = [i for i, row in seen if row["out_of_tolerance_fraction"] > 0.0]
    worst = sorted(seen, key=lambda item: -item[1]["rms"])[:WORST_FACES]
    named = any(part.names)
    rows = [(i, *([part.names[i]] if named else []), f"{row['count']:,}",
             lengths.signed(row["mean"], 1), lengths.text(row["rms"], 1), lengths.signed(row["minimum"], 1),
             lengths.signed(row["maximum"], 1), f"{row['out_of_tolerance_fraction']:.1%}")
            for i, row in worst]
    header = ("Face", *(["Name"] if named else []), "Points", "Mean", "RMS", "Minimum", "Maximum",
              "Out of tolerance")
    numbers = range(2 if named else 0, len(header))
    empty = len(faces) - len(seen)
    return (f"<p>{len(seen)} of {len(faces)} faces have points, {len(bad)} of them some out of "
            f"tolerance; {empty} were not scanned. The worst by RMS, without outliers:</p>\n"
            + table(header, rows, numbers))


def outliers_text(inspection, scan):
    """How the outliers that were found compare with those of a simulated scan."""
    if scan is None:
        return ""
    missed = scan.is_outlier & ~inspection.outliers
    within = np.abs(inspection.result.signed_distance[missed]) <= inspection.tolerance
    return (f" found, {np.sum(inspection.outliers & ~scan.is_outlier)} of them wrongly; "
            f"{scan.is_outlier.sum():,} injected, {within.sum()} of them within tolerance and "
            f"{np.sum(~within)} missed")


def write_report(path, part, inspection, lengths, seconds, picture, scan=None):
    """picture: path of the PNG; scan: the simulated Scan, None for a real one."""
    result, good = inspection.result, inspection.good
    distances = result.signed_distance
    well, words = verdict(part, inspection, lengths)
    found = distances[np.isfinite(distances)]
    columns = (FIGURES.values(), as_text(statistics(found, inspection.tolerance), lengths),
               as_text(statistics(distances[good], inspection.tolerance), lengths))
    unit = part.unit
    if part.file_unit != part.declared_unit:
        unit += (f"; the numbers in the CAD file are taken as {part.file_unit}, although it says "
                 f"{part.declared_unit}")
    elif part.unit != part.file_unit:
        unit += f"; the CAD file is in {part.file_unit}"
    edges = result.statistics["open_edges"]
    about = [
        ("CAD file", part.path.name), ("Faces", f"{len(part.names)}, exact and trimmed" + (
            f"; {part.unread} of them cannot be converted and are left out" if part.unread
            else "")),
        ("Solid", "closed: deviations are negative inside" if edges == 0 else
         f"open, with {edges} borders where no other face begins: deviations are positive on the "
         "side of the faces' normals"),
        ("Unit", unit), ("Size", f"{part.size:.4g} {part.unit} from corner to corner"),
        ("Scan", f"{len(distances):,} points" + (", simulated" if scan is not None else "")),
        ("Noise", f"{lengths.text(inspection.noise)}, standard deviation, from the median"),
        ("Outliers", f"{inspection.outliers.sum():,}" + outliers_text(inspection, scan)),
        ("Tolerance", "±" + lengths.text(inspection.tolerance, 2)),
        ("Time", f"{1e6 * seconds / len(distances):.1f} µs a point, {seconds:.2f} s in all, on "
         f"{os.cpu_count()} processors")]
    status = counts(result.status, footpoint.Status)
    image = base64.b64encode(picture.read_bytes()).decode()
    path.write_text(f"""\
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Deviation of {escape(part.path.name)}</title>
<style>{STYLE}</style></head><body>
<h1>{escape(part.path.name)}: scan against CAD</h1>
<p class="verdict {'good' if well else 'bad'}">{escape(words)}</p>
<img alt="Deviation of the scan from the CAD model" src="data:image/png;base64,{image}">
<h2>What was measured</h2>
{table(None, about, ())}
<h2>Deviation</h2>
{table(("", "all points", "without outliers"), list(zip(*columns)), (1, 2))}
<h2>Regions out of tolerance</h2>
{regions_section(part, inspection, lengths, scan)}
<h2>Faces</h2>
{faces_section(part, inspection, lengths)}
<h2>Certificate</h2>
<p>Of {len(result.status):,} nearest points: {status}. Certified means proved: no point of the CAD
model is nearer than the distance says. Distances are from the exact surfaces; nothing was
tessellated for them. Where the feet lie: {counts(result.foot_type, footpoint.FootType)}.</p>
<p class="note">Footpoint {footpoint.__version__}, VTK {vtkVersion.GetVTKVersion()}, Python \
{platform.python_version()}. Beside this file: deviation.vtp (all points and arrays), faces.csv,
deviation.png, and paraview_state.py, which opens the inspection in ParaView by File &gt; Load
State.</p>
</body></html>
""", encoding="utf-8")
