# SPDX-License-Identifier: BSD-3-Clause
"""STEP, IGES and BREP files as exact geometry."""

import errno
from typing import NamedTuple
import os

from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData

from . import vtkFootpointIO
from ._options import set_options
from ._pipeline import run


class CADParts(NamedTuple):
    """What a CAD file holds."""

    model: vtkMultiBlockDataSet  #: exact faces, a block each
    mesh: vtkPolyData  #: triangles for the screen
    edges: vtkMultiBlockDataSet  #: exact edges, a block each


def read_cad(path, **options):
    """The exact faces of a STEP, IGES or BREP file, as geometry for `invert` and `evaluate`.

    Parameters
    ----------
    path : str or path
        The file; its kind is told by its content. It may be compressed by gzip.

    Options
    -------
    Those of vtkCADReader.

    length_unit : str, default ""
        Unit of the result: nm, um, mm, cm, m, km, uin, mil, inch, ft, yd or mi; "": the file's.
    faces : str or ints, default ""
        Numbers of the faces to read, as "0-3,7" or a sequence; "": all.
    healing : bool, default False
        Let Open CASCADE repair the shape first, which may move geometry within tolerances.
    time_limit : float, default 50.0
        Seconds without any sign of progress after which reading is given up.
    generate_mesh, deflection, angular_deflection
        See `read_cad_parts`; here no mesh is made.

    Returns
    -------
    vtkMultiBlockDataSet
        A block a face, numbered from 0; None for faces that are not read.

    Raises
    ------
    FileNotFoundError where there is no such file, ValueError where it cannot be read (the message
    is Open CASCADE's reason), ImportError where Footpoint was built without Open CASCADE. Faces that
    cannot be converted are RuntimeWarnings.
    """
    options.setdefault("generate_mesh", False)
    return _read(path, options, "read_cad").model


def read_cad_parts(path, **options):
    """Faces, display mesh and edges of a STEP, IGES or BREP file.

    As `read_cad`, and besides:

    generate_mesh : bool, default True
        Make the display mesh.
    deflection : float, default 0.0
        Largest distance of its triangles from the faces; 0: a thousandth of the model's diagonal.
    angular_deflection : float, default 20.0
        Largest angle between neighbouring pieces, in degrees.

    Returns
    -------
    CADParts
        `model`, `mesh` (triangles with the cell array FaceId, normals of the exact surfaces and the
        file's colours) and `edges` (a block an edge, with the field data EdgeId and FaceIds).
    """
    return _read(path, options, "read_cad_parts")


def _read(path, options, function):
    reader_class = getattr(vtkFootpointIO, "vtkCADReader", None)
    if reader_class is None:
        raise ImportError(
            "this Footpoint was built without Open CASCADE (FOOTPOINT_WITH_OCCT), which reads CAD "
            "files; on Debian: libocct-data-exchange-dev"
        )
    path = os.fspath(path)
    if not os.path.exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
    faces = options.get("faces", "")
    if not isinstance(faces, str):
        options["faces"] = ",".join(str(int(number)) for number in faces)
        if not options["faces"]:
            raise ValueError("faces is an empty sequence; '' reads all")
    if "file_name" in options:
        raise TypeError(f"{function}() takes the file as path, not as file_name")
    reader = reader_class()
    reader.SetFileName(path)
    set_options(reader, options, function)
    run(reader)
    return CADParts(reader.GetModelOutput(), reader.GetOutput(), reader.GetEdgesOutput())
