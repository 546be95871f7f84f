# SPDX-License-Identifier: BSD-3-Clause
"""What the programs that run on several ranks share: the controller, and a runner that ends all ranks
as soon as one fails, so that none waits for ever.
"""

import ctypes
import os
import sys
import time
import traceback

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules import vtkParallelMPI
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController


def start():
    """The global controller of all ranks: ParaView's, or one of our own."""
    controller = vtkMultiProcessController.GetGlobalController()
    if controller is None or not controller.IsA("vtkMPIController"):
        # VTK's wrapped Initialize() wants an MPI that runs. The module is linked to it, so that its
        # functions are found there whatever the library is called.
        ctypes.CDLL(vtkParallelMPI.__file__).MPI_Init(None, None)
        controller = vtkMPIController()
        controller.Initialize()
        vtkMultiProcessController.SetGlobalController(controller)
    return controller


def run(tests, controller, together=True):
    """Runs the functions, each with the controller; one failure ends the job.

    together: on all ranks; else on this one, whose satellites do as it says.
    """
    rank = controller.GetLocalProcessId()
    expected = os.environ.get("FOOTPOINT_RANKS")
    try:
        if expected:
            assert controller.GetNumberOfProcesses() == int(expected), "wrong number of ranks"
        for test in tests:
            begin = time.perf_counter()
            test(controller)
            if together:
                controller.Barrier()
            if rank == 0:
                print(f"{test.__name__}: ok, {time.perf_counter() - begin:.2f} s", flush=True)
    except BaseException:
        traceback.print_exc()
        print(f"rank {rank} failed", flush=True)
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(1)  # mpiexec ends the other ranks


def share(count, controller):
    """(first, last) of `count` rows for this rank: parts of unequal size that cover all."""
    ranks = controller.GetNumberOfProcesses()
    weights = np.arange(1, ranks + 1)
    ends = np.concatenate([[0], np.round(np.cumsum(weights) / weights.sum() * count)]).astype(int)
    rank = controller.GetLocalProcessId()
    return ends[rank], ends[rank + 1]


def points_data(rows):
    """vtkPolyData of an (n, 3) array."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(rows, dtype=float).reshape(-1, 3), deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    return data


def point_arrays(data):
    """{name: array} of a data set, its points among them."""
    attributes = data.GetPointData()
    result = {}
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(i)
        result[array.GetName()] = vtk_to_numpy(array).copy()
    return result


def statistics(data):
    """{name: numbers} of all statistics in the field data."""
    fields = data.GetFieldData()
    return {
        fields.GetArrayName(i): vtk_to_numpy(fields.GetArray(i)).copy()
        for i in range(fields.GetNumberOfArrays())
        if fields.GetArray(i) is not None
    }


def table_rows(table):
    """{column: list of values} of a vtkTable."""
    result = {}
    for c in range(table.GetNumberOfColumns()):
        column = table.GetColumn(c)
        result[table.GetColumnName(c)] = [
            table.GetValue(r, c).ToString() for r in range(table.GetNumberOfRows())]
        del column
    return result


def same_bits(a, b, what):
    """Fails unless two dictionaries of arrays have the same names, types and bits."""
    assert set(a) == set(b), f"{what}: {sorted(set(a) ^ set(b))}"
    for name in a:
        x, y = a[name], b[name]
        assert x.dtype == y.dtype and x.shape == y.shape, f"{what}, {name}: {x.shape} {y.shape}"
        assert x.tobytes() == y.tobytes(), f"{what}, {name}: other bits: {x} {y}"
