# SPDX-License-Identifier: BSD-3-Clause
"""Points of a scan from a file."""

import pathlib

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from .part import InputError

READERS = {".ply": vtkPLYReader, ".stl": vtkSTLReader, ".vtp": vtkXMLPolyDataReader}
TEXTS = (".csv", ".xyz", ".txt")
HEADERS = (("x", "y", "z"), ("points:0", "points:1", "points:2"))  # the second is ParaView's


def read_scan(path):
    """(m, 3) points of a .ply, .stl, .vtp, .csv, .xyz or .txt file. Raises InputError."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise InputError(f"there is no scan {path}")
    kind = path.suffix.lower()
    if kind in READERS:
        reader = READERS[kind]()
        reader.SetFileName(str(path))
        reader.GlobalWarningDisplayOff()
        reader.Update()
        reader.GlobalWarningDisplayOn()
        points = reader.GetOutput().GetPoints()
        points = np.empty((0, 3)) if points is None else vtk_to_numpy(points.GetData())
    elif kind in TEXTS:
        points = read_text(path)
    else:
        known = ", ".join((*READERS, *TEXTS))
        raise InputError(f"{path} is of no known kind of scan; these are {known}")
    if len(points) == 0:
        raise InputError(f"no points in {path}")
    return points.astype(float)


def read_text(path):
    """Rows of numbers, divided by commas, blanks or semicolons, with which commas are decimal. x, y
    and z are the columns of that name if the first row has names, else the first three; lines with #
    are comments.
    """
    text = path.read_text(encoding="utf-8", errors="replace")
    lines = [(number, split(line)) for number, line in enumerate(text.splitlines(), 1)
             if line.strip() and not line.lstrip().startswith(("#", "//"))]
    columns = [0, 1, 2]
    if lines and not is_number(lines[0][1][0]):
        names = [name.strip('"').lower() for name in lines[0][1]]
        columns = next(([names.index(n) for n in header] for header in HEADERS
                        if set(header) <= set(names)), None)
        if columns is None:
            raise InputError(f"{path}: the columns {', '.join(names)} have no x, y and z")
        del lines[0]
    points = np.empty((len(lines), 3))
    for point, (number, words) in zip(points, lines):
        try:
            point[:] = [float(words[column]) for column in columns]
        except (IndexError, ValueError):
            start = " ".join(words)[:60]
            raise InputError(
                f"{path}, line {number}: no three coordinates in '{start}'") from None
    return points


def split(line):
    if ";" in line:
        return [word.strip() for word in line.replace(",", ".").split(";")]
    return [word.strip() for word in line.split(",")] if "," in line else line.split()


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def check_size(points, part):
    """Refuses a scan that is so much larger or smaller than the part that units must differ."""
    good = points[np.isfinite(points).all(axis=1)]
    if len(good) == 0:
        raise InputError("all points of the scan have coordinates that are no numbers")
    low, high = np.percentile(good, (1, 99), axis=0)  # without outliers
    size = np.linalg.norm(high - low)
    if not 0.02 * part.size < size < 5.0 * part.size:
        raise InputError(
            f"the scan measures {size:.4g}, the part {part.size:.4g} {part.unit}. Are their units "
            "different? Say in which the scan is by --unit, or in which the numbers of the CAD file "
            "are, if not in what it says, by --cad-unit")
