# SPDX-License-Identifier: BSD-3-Clause
"""What all functions share: arrays to VTK and back, geometry as a second input, errors."""

import re
import warnings

import numpy as np
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricFunction
from vtkmodules.vtkCommonCore import VTK_STRING, vtkObject
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkMultiBlockDataSet
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkAlgorithmOutput


def as_numbers(values, name):
    """A NumPy array of float32 or float64 in row order; a copy only where it has to be one."""
    try:
        array = np.asarray(values)
    except ValueError:
        array = np.empty(0, dtype=object)  # rows of different lengths
    if array.dtype.kind not in "fiub":
        raise ValueError(f"{name} is no array of real numbers (its dtype is {array.dtype})")
    single = array.dtype.newbyteorder("=") == np.float32
    return np.asarray(array, dtype=np.float32 if single else np.float64, order="C")


def as_integers(values, name, count):
    """A NumPy array of `count` int64; one number stands for all rows."""
    array = np.asarray(values)
    if array.dtype.kind not in "iu" and array.size > 0:
        raise ValueError(f"{name} is no array of integers (its dtype is {array.dtype})")
    if array.shape not in ((), (count,)):
        raise ValueError(f"{name} has shape {array.shape}; ({count},) is needed, or one number")
    return np.ascontiguousarray(np.broadcast_to(array, count), dtype=np.int64)


def to_vtk(array, name=None, copy=False):
    """A VTK array on the memory of `array`, which has to live as long, unless `copy`."""
    result = numpy_to_vtk(array, deep=copy)
    if name:
        result.SetName(name)
    return result


def to_numpy(attributes, name):
    """The array of that name on VTK's own memory (kept alive), or None where there is none."""
    array = attributes.GetArray(name)
    return None if array is None else vtk_to_numpy(array)


def to_model(faces):
    """A vtkMultiBlockDataSet of the faces in order; None uses up its number."""
    result = vtkMultiBlockDataSet()
    result.SetNumberOfBlocks(len(faces))
    for i, face in enumerate(faces):
        if isinstance(face, (list, tuple)):
            face = to_model(face)
        if face is not None and not isinstance(face, vtkDataObject):
            raise TypeError(f"face {i} is a {type(face).__name__}; VTK data is needed, or None")
        result.SetBlock(i, face)
    return result


def set_geometry(algorithm, geometry):
    """Gives an algorithm its geometry, whatever kind it is of.

    On several ranks it works for its own alone: they need not call at the same time.
    """
    algorithm.SetController(None)
    if isinstance(geometry, vtkParametricFunction):
        algorithm.SetParametricFunction(geometry)
    else:
        connect(
            geometry,
            algorithm.SetSourceConnection,
            algorithm.SetSourceData,
            "VTK data, a vtkParametricFunction, an algorithm or a list of faces",
        )


def connect(geometry, set_connection, set_data, kinds="VTK data, an algorithm or a list of faces"):
    """Hands geometry to the input of an algorithm that these setters set; TypeError for other kinds."""
    if isinstance(geometry, vtkAlgorithm):
        set_connection(geometry.GetOutputPort())
    elif isinstance(geometry, vtkAlgorithmOutput):
        set_connection(geometry)
    elif isinstance(geometry, vtkDataObject):
        set_data(geometry)
    elif isinstance(geometry, (list, tuple)):
        set_data(to_model(geometry))
    else:
        raise TypeError(f"geometry is a {type(geometry).__name__}; {kinds} is needed")


def _message(text):
    """The text of vtkErrorMacro or vtkWarningMacro without file, line and address."""
    return re.sub(r"\A\w+: In .*, line \d+\n\w+ \(0x[0-9a-f]+\): ", "", text).strip()


def run(algorithm):
    """Updates an algorithm; its errors become a ValueError, its warnings RuntimeWarnings.

    An observer catches them, so that VTK prints nothing.
    """
    messages = {"ErrorEvent": [], "WarningEvent": []}

    @calldata_type(VTK_STRING)
    def note(_, event, text):
        messages[event].append(_message(text))

    executive = algorithm.GetExecutive()
    tags = [(o, o.AddObserver(e, note)) for o in (algorithm, executive) for e in messages]
    # Switched off, errors would not even reach an observer.
    display = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOn()
    try:
        algorithm.Update()
    finally:
        vtkObject.SetGlobalWarningDisplay(display)
        for observed, tag in tags:
            observed.RemoveObserver(tag)

    errors = messages["ErrorEvent"]
    # The executive adds that its algorithm failed, with a dump of the request.
    reasons = [text for text in errors if "returned failure for request" not in text]
    if errors:
        raise ValueError("\n".join(reasons or errors))
    for text in messages["WarningEvent"]:
        warnings.warn(text, RuntimeWarning, stacklevel=3)
