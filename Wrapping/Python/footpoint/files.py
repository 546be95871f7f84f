# SPDX-License-Identifier: BSD-3-Clause
"""Files of splines, over vtkSplineReader and vtkSplineWriter."""

import os

from ._options import set_options
from ._pipeline import connect, run
from .vtkFootpointIO import vtkSplineReader, vtkSplineWriter


def read_splines(path, format="Auto"):
    """Spline curves and surfaces of a file, number for number.

    Parameters
    ----------
    path : str or path-like
        A file of G+Smo (.xml), GoTools (.g2) or geomdl, also called NURBS-Python (.json).
    format : str or int
        Auto (by the extension), GPlusSmo, GoTools or Geomdl.

    Returns
    -------
    vtkMultiBlockDataSet
        A block for every spline, in the order of the file: what `nurbs_curve`, `nurbs_surface` and
        `trimmed_face` make. Names in the file are block names and the field data `FaceName`.

    Raises
    ------
    ValueError
        The file cannot be read, is malformed (the text names the line and what was expected there)
        or has no spline. What it has besides splines is left out with a RuntimeWarning.
    """
    reader = vtkSplineReader()
    reader.SetFileName(os.fspath(path))
    set_options(reader, {"format": format}, "read_splines")
    run(reader)
    return reader.GetOutput()


def write_splines(geometry, path, format="Auto"):
    """Writes spline curves and surfaces into a file, from which the same bits are read again.

    Parameters
    ----------
    geometry
        A surface, a curve, a trimmed face, a composite data set or a list of them, or an algorithm
        that makes one.
    path : str or path-like
        The file; what is there is replaced.
    format : str or int
        Auto (by the extension: .xml, .g2 or .json), GPlusSmo, GoTools or Geomdl.

    Returns
    -------
    None

    Raises
    ------
    ValueError
        The geometry is bad, the file cannot be written, or the format cannot hold the geometry:
        trimmed faces and Orientation -1 in G+Smo and GoTools, curves and surfaces in one file of
        geomdl. Nothing is written then. Names that GoTools cannot hold, empty blocks and arrays that
        are no spline are left out with a RuntimeWarning.
    TypeError
        `geometry` is of a type that is none of those.
    """
    writer = vtkSplineWriter()
    connect(geometry, writer.SetInputConnection, writer.SetInputDataObject)
    writer.SetFileName(os.fspath(path))
    set_options(writer, {"format": format}, "write_splines")
    run(writer)
