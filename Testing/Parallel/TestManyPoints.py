# SPDX-License-Identifier: BSD-3-Clause
"""Many points shared out among ranks: no rank needs more memory than for its own points, there is
progress, and an abort on one rank stops all within a second. Prints what it measures.

    mpiexec -n 2 python3 TestManyPoints.py [number of points of all ranks together, default 400000]
"""

import re
import sys
import time

import numpy as np
from vtkmodules.vtkCommonCore import vtkDoubleArray

import footpoint
from ranks import points_data, run, share, start

NUMBERS = [int(word) for word in sys.argv[1:] if word.isdigit()]
COUNT = NUMBERS[0] if NUMBERS else 400000
#: Of memory against arrays: blocks of points under way, and what the allocator keeps.
MOST_MEMORY = 1.5
ALLOWANCE_MB = 40  # of a run with hardly any points
MOST_SECONDS_TO_ABORT = 1.0


def make_net():
    """A bicubic surface of 40 by 40 control points over [0, 10]²."""
    u, v = np.meshgrid(np.linspace(0, 10, 40), np.linspace(0, 10, 40), indexing="ij")
    height = 0.5 * np.sin(1.3 * u) * np.cos(0.9 * v)
    knots = np.concatenate([[0] * 3, np.linspace(0, 1, 38), [1] * 3])
    return footpoint.nurbs_surface(np.stack([u, v, height], axis=-1), knots, knots)


def memory_mb(kind):
    """VmRSS (of now) or VmHWM (the most so far) of this process."""
    with open("/proc/self/status", encoding="ascii") as status:
        return int(re.search(rf"{kind}:\s+(\d+)", status.read()).group(1)) / 1024


def arrays_mb(*data_sets):
    """Megabytes of all arrays, each once although outputs share them."""
    arrays = {}
    for data in data_sets:
        found = [data.GetPoints().GetData()]
        attributes = data.GetPointData()
        found += [attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())]
        if data.GetNumberOfVerts():
            found += [data.GetVerts().GetOffsetsArray(), data.GetVerts().GetConnectivityArray()]
        arrays.update({array.GetVoidPointer(0): array.GetActualMemorySize() for array in found})
    return sum(arrays.values()) / 1024


def test_many_points(controller):
    rank = controller.GetLocalProcessId()
    first, last = share(COUNT, controller)
    algorithm = footpoint.vtkPointInversionFilter()
    algorithm.SetSourceData(make_net())
    # What is there without many points: libraries, the model.
    algorithm.SetInputData(points_data(np.full((1, 3), 5.0)))
    algorithm.Update()
    before = memory_mb("VmRSS")

    generator = np.random.default_rng(rank)
    points = points_data(generator.uniform([0, 0, -1], [10, 10, 1], (last - first, 3)))
    algorithm.SetInputData(points)
    steps = []
    tag = algorithm.AddObserver("ProgressEvent", lambda a, _: steps.append(a.GetProgress()))
    controller.Barrier()
    begin = time.perf_counter()
    algorithm.Update()
    seconds = time.perf_counter() - begin
    algorithm.RemoveObserver(tag)
    output = algorithm.GetOutputDataObject(0)
    arrays = arrays_mb(points, output, algorithm.GetOutputDataObject(1))
    used = memory_mb("VmHWM") - before
    count = output.GetFieldData().GetArray("DistanceCount").GetValue(0)
    print(f"rank {rank}: {last - first} points in {seconds:.2f} s, {used:.0f} MB at most for "
          f"{arrays:.0f} MB of arrays ({used / arrays:.2f}), {len(steps)} steps of progress",
          flush=True)
    assert count == COUNT, f"statistics of {count} points"
    assert used < MOST_MEMORY * arrays + ALLOWANCE_MB
    assert len(steps) >= min(4, seconds) and steps == sorted(steps)


def test_abort(controller):
    """As soon as a fifth is done on rank 0, it stops."""
    rank = controller.GetLocalProcessId()
    first, last = share(COUNT, controller)
    generator = np.random.default_rng(rank)
    algorithm = footpoint.vtkPointInversionFilter()
    algorithm.SetSourceData(make_net())
    algorithm.SetInputData(
        points_data(generator.uniform([0, 0, -1], [10, 10, 1], (last - first, 3))))
    told = vtkDoubleArray()
    told.InsertNextValue(0.0)

    def stop(caller, _):
        if rank == 0 and 0.2 < caller.GetProgress() < 1.0 and told.GetValue(0) == 0.0:
            told.SetValue(0, time.perf_counter())
            caller.AbortExecuteOn()

    algorithm.AddObserver("ProgressEvent", stop)
    controller.Barrier()
    algorithm.Update()
    end = time.perf_counter()
    # The clock is one for all processes of a machine.
    controller.Broadcast(told, 0)
    seconds = end - told.GetValue(0)
    print(f"rank {rank}: stopped {seconds:.3f} s after rank 0 wanted it", flush=True)
    assert told.GetValue(0) > 0 and algorithm.GetOutputDataObject(0).GetNumberOfPoints() == 0
    assert seconds < MOST_SECONDS_TO_ABORT


if __name__ == "__main__":
    everything = start()
    run([test_many_points, test_abort], everything)
    if "--finalize" in sys.argv:
        everything.Finalize()
