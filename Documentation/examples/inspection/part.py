# SPDX-License-Identifier: BSD-3-Clause
"""The nominal part: exact faces of a CAD file, their triangles for the screen, names and unit."""

import pathlib
from dataclasses import dataclass

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkMassProperties

METRES = {  # in one unit
    "nm": 1e-9, "um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0, "km": 1e3, "uin": 2.54e-8,
    "mil": 2.54e-5, "inch": 0.0254, "ft": 0.3048, "yd": 0.9144, "mi": 1609.344}


class InputError(Exception):
    """Something that the user can mend: a file, a unit, an option. The text says what."""


@dataclass
class Part:
    path: pathlib.Path
    model: vtkMultiBlockDataSet  # exact, as footpoint.invert takes it; a block a face
    mesh: vtkPolyData  # triangles with normals and the cell array FaceId
    names: list  # of the faces, "" where the file gives none that tells faces apart
    unread: int  # faces that could not be converted
    unit: str  # of all lengths
    declared_unit: str  # what the file says its numbers are
    file_unit: str  # what they are taken as

    @property
    def area(self):
        properties = vtkMassProperties()
        properties.SetInputData(self.mesh)
        return properties.GetSurfaceArea()

    @property
    def size(self):
        """Diagonal of the bounding box."""
        return np.linalg.norm(np.ptp(np.reshape(self.mesh.GetBounds(), (3, 2)), axis=1))


def surface_nets(model):
    """The control net of every face, None for faces that could not be read."""
    blocks = (model.GetBlock(i) for i in range(model.GetNumberOfBlocks()))
    return [block.GetBlock(0) if isinstance(block, vtkMultiBlockDataSet) else block
            for block in blocks]


def scale(points, factor):
    """vtkPoints times a number."""
    scaled = vtkPoints()
    scaled.SetData(numpy_to_vtk(factor * vtk_to_numpy(points.GetData()), deep=True))
    return scaled


def read_part(path, unit=None, cad_unit=None):
    """Reads STEP, IGES or BREP, also compressed by gzip.

    unit: of the result, else that of the file. cad_unit: what the numbers in the file are, where
    its own declaration is wrong. Raises InputError.
    """
    path = pathlib.Path(path)
    try:
        parts = footpoint.read_cad_parts(path)
    except FileNotFoundError:
        raise InputError(f"there is no CAD file {path}") from None
    except (ValueError, ImportError) as error:
        raise InputError(f"cannot read {path}: {error}") from None
    model, mesh = parts.model, parts.mesh
    if mesh.GetNumberOfPolys() == 0:
        raise InputError(f"there are no faces in {path}")

    nets = surface_nets(model)
    fields = [None if net is None else net.GetFieldData() for net in nets]
    declared = next(f.GetAbstractArray("LengthUnit").GetValue(0) for f in fields if f)
    unit = unit or cad_unit or declared
    factor = METRES[cad_unit or declared] / METRES[unit]
    if factor != 1.0:
        mesh.SetPoints(scale(mesh.GetPoints(), factor))
        for net, field in zip(nets, fields):
            if net is not None:
                net.SetPoints(scale(net.GetPoints(), factor))
                field.GetArray("Tolerance").SetValue(
                    0, factor * field.GetArray("Tolerance").GetValue(0))
                field.GetAbstractArray("LengthUnit").SetValue(0, unit)
    names = [field and field.GetAbstractArray("FaceName") for field in fields]
    names = [name.GetValue(0) if name else "" for name in names]
    if len(set(names)) == 1:
        names = [""] * len(names)  # the name of the whole
    return Part(path, model, mesh, names, nets.count(None), unit, declared, cad_unit or declared)
