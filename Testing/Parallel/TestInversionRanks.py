# SPDX-License-Identifier: BSD-3-Clause
"""The filters on any number of ranks: the bits of one rank, whoever has the points and the geometry;
an error or an abort on one rank ends all and leaves none waiting.
"""

import sys
import time

import numpy as np
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import VTK_STRING, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_CURVE, vtkMultiBlockDataSet, vtkPartitionedDataSet, vtkPartitionedDataSetCollection,
    vtkPolyData, vtkStructuredGrid, vtkUnstructuredGrid)

import footpoint
from ranks import (
    point_arrays, points_data, run, same_bits, share, start, statistics, table_rows)

COUNT = 2000
ROWS = np.random.default_rng(5).uniform([-0.5, -0.5, -1], [2.5, 1.5, 1], (COUNT, 3))
ROWS[17] = np.nan  # a point that cannot be inverted


def make_net(seed=3, shift=0.0):
    """A rational surface over [0, 1]², moved along x."""
    generator = np.random.default_rng(seed)
    u, v = np.meshgrid(np.linspace(0, 1, 6), np.linspace(0, 1, 4), indexing="ij")
    return footpoint.nurbs_surface(
        np.stack([u + shift, v, generator.uniform(-0.3, 0.3, u.shape)], axis=-1),
        [0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1],
        [0, 0, 0, 0.5, 1, 1, 1],
        weights=generator.uniform(0.5, 2, u.shape),
    )


def blocks(*data):
    result = vtkMultiBlockDataSet()
    result.SetNumberOfBlocks(len(data))
    for i, block in enumerate(data):
        result.SetBlock(i, block)
    return result


def make_filter(points, source, serial=False, **options):
    algorithm = footpoint.vtkPointInversionFilter()
    if serial:
        algorithm.SetController(None)
    algorithm.SetInputDataObject(0, points)
    if source is not None:
        algorithm.SetSourceData(source)
    for name, value in options.items():
        getattr(algorithm, "Set" + name)(value)
    return algorithm


def errors_of(algorithm):
    """Updates it; its errors, caught before VTK prints them."""
    messages = []

    @calldata_type(VTK_STRING)
    def note(_, __, text):
        messages.append(text)

    executive = algorithm.GetExecutive()
    tags = [(o, o.AddObserver("ErrorEvent", note)) for o in (algorithm, executive)]
    algorithm.Update()
    for observed, tag in tags:
        observed.RemoveObserver(tag)
    return "\n".join(m for m in messages if "returned failure" not in m)


def compare(algorithm, rows, first, last, source, controller, what, **options):
    """Updates it and compares with one rank that has all rows and the whole source."""
    expected = make_filter(points_data(rows), source, serial=True, **options)
    expected.Update()
    error = errors_of(algorithm)
    assert not error, f"{what}: {error}"
    own = algorithm.GetOutputDataObject(0)
    whole = expected.GetOutputDataObject(0)
    part = {n: a[first:last] for n, a in point_arrays(whole).items()}
    if own.IsA("vtkPolyData"):
        same_bits(point_arrays(own), part, what)
    same_bits(statistics(own), statistics(whole), f"{what}, statistics")
    columns = table_rows(expected.GetOutputDataObject(2))
    if controller.GetLocalProcessId() > 0:
        columns = {name: [] for name in columns}
    assert table_rows(algorithm.GetOutputDataObject(2)) == columns, f"{what}, table"
    return expected


def test_points_are_shared_out(controller):
    net = make_net()
    first, last = share(COUNT, controller)
    for options in ({}, {"DeviationTolerance": 0.2, "FlipNormals": True}, {"Search": 1},
                    {"MaximumDistance": 0.3}, {"ArrayNamePrefix": "My"}):
        algorithm = make_filter(points_data(ROWS[first:last]), net, **options)
        compare(algorithm, ROWS, first, last, net, controller, str(options), **options)
    # All on the last rank, none on the others: no points, and no points object at all.
    last_rank = controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1
    for empty in (points_data(ROWS[:0]), vtkPolyData()):
        algorithm = make_filter(points_data(ROWS) if last_rank else empty, net)
        compare(algorithm, ROWS, 0, COUNT if last_rank else 0, net, controller, "last rank alone")
        names = point_arrays(algorithm.GetOutputDataObject(1))
        assert "ClosestPoint" in names and "PointId" in names, "arrays without rows"
    # Nobody has any.
    algorithm = make_filter(points_data(ROWS[:0]), net)
    compare(algorithm, ROWS[:0], 0, 0, net, controller, "no points at all")


def test_source_on_one_rank(controller):
    net, other = make_net(), make_net(4, 1.2)
    first, last = share(COUNT, controller)
    for source in (net, blocks(net, None, other), trimmed()):
        for rank in range(controller.GetNumberOfProcesses()):
            here = rank == controller.GetLocalProcessId()
            for empty in (None, vtkStructuredGrid(), vtkMultiBlockDataSet()):
                algorithm = make_filter(points_data(ROWS[first:last]), source if here else empty)
                compare(algorithm, ROWS, first, last, source, controller, f"source on rank {rank}")
                assert algorithm.GetNumberOfModelBuilds() == 1


def trimmed():
    angle = np.linspace(0, 2 * np.pi, 40)
    loop = 0.5 + 0.3 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return footpoint.trimmed_face(make_net(), [[loop]])


def test_blocks_of_points(controller):
    """Different numbers of blocks, null ones among them, in all kinds of composites."""
    net = make_net()
    first, last = share(COUNT, controller)
    rank = controller.GetLocalProcessId()
    cuts = np.linspace(first, last, rank + 1).astype(int)  # rank 0 has no block at all
    if rank == 0:
        cuts = np.array([first, last])
    parts = [points_data(ROWS[a:b]) for a, b in zip(cuts[:-1], cuts[1:])]
    multi = blocks(None, *parts, None)
    partitions = vtkPartitionedDataSet()
    for i, part in enumerate(parts):
        partitions.SetPartition(i, part)
    collection = vtkPartitionedDataSetCollection()
    collection.SetPartitionedDataSet(0, partitions)
    for data in (multi, partitions, collection):
        algorithm = make_filter(data, net)
        expected = compare(algorithm, ROWS, first, last, net, controller, data.GetClassName())
        output = algorithm.GetOutputDataObject(0)
        iterator = output.NewIterator()
        iterator.InitTraversal()
        for a, b in zip(cuts[:-1], cuts[1:]):
            whole = point_arrays(expected.GetOutputDataObject(0))
            same_bits(point_arrays(iterator.GetCurrentDataObject()),
                      {n: rows[a:b] for n, rows in whole.items()}, f"block {a}")
            iterator.GoToNextItem()
        assert iterator.IsDoneWithTraversal()
    # Only rank 0 has a block, and its composite holds a block that is no point set elsewhere.
    data = blocks(points_data(ROWS)) if rank == 0 else vtkMultiBlockDataSet()
    algorithm = make_filter(data, net)
    compare(algorithm, ROWS, 0, 0, net, controller, "blocks on rank 0 alone")


def test_leaves_of_the_source(controller):
    """Each rank has other blocks of a model, some ranks fewer, some the same."""
    ranks = controller.GetNumberOfProcesses()
    rank = controller.GetLocalProcessId()
    nets = [make_net(seed, 1.1 * seed) for seed in range(5)]
    nets[2] = None
    whole = blocks(*nets)
    own = vtkMultiBlockDataSet()
    for i, net in enumerate(nets):
        if i % ranks == rank or i == 1:
            own.SetBlock(i, net)
    first, last = share(COUNT, controller)
    algorithm = make_filter(points_data(ROWS[first:last]), own)
    compare(algorithm, ROWS, first, last, whole, controller, "blocks shared out")

    # A collection of nets, and one whose partition is on the last rank alone.
    collection = vtkPartitionedDataSetCollection()
    serial = vtkPartitionedDataSetCollection()
    for i, net in enumerate(nets[:2]):
        for target in ([serial, collection] if i == 0 or rank == ranks - 1 else [serial]):
            partition = vtkPartitionedDataSet()
            partition.SetPartition(0, net)
            target.SetPartitionedDataSet(i, partition)
    algorithm = make_filter(points_data(ROWS[first:last]), collection)
    compare(algorithm, ROWS, first, last, serial, controller, "collection")

    # Different nets at one place: side by side, in the order of the ranks.
    other = make_net(10 + rank, 1.1 * rank)
    algorithm = make_filter(points_data(ROWS[first:last]), other)
    side_by_side = blocks(*(make_net(10 + r, 1.1 * r) for r in range(ranks)))
    compare(algorithm, ROWS, first, last, side_by_side, controller, "different nets")


def cut_net(net, first, last):
    """Columns of control points of a net, with its field data, as VTK's own filters cut it."""
    part = vtkStructuredGrid()
    extent = list(net.GetExtent())
    extent[0], extent[1] = first, last
    part.ShallowCopy(net)
    part.Crop(extent)
    return part


def test_net_that_was_cut(controller):
    net = make_net()
    ranks = controller.GetNumberOfProcesses()
    rank = controller.GetLocalProcessId()
    first, last = share(COUNT, controller)
    ends = np.linspace(0, 5, ranks + 1).astype(int)
    part = cut_net(net, ends[rank], ends[rank + 1])
    algorithm = make_filter(points_data(ROWS[first:last]), part)
    compare(algorithm, ROWS, first, last, net, controller, "cut net")
    algorithm = make_filter(points_data(ROWS[first:last]), blocks(None, part))
    compare(algorithm, ROWS, first, last, blocks(None, net), controller, "cut net in a block")
    if ranks == 1:
        return
    # A column that no rank has; a point that two ranks have in different places.
    short = cut_net(net, ends[rank], ends[rank + 1] - (1 if rank == ranks - 1 else 0))
    error = errors_of(make_filter(points_data(ROWS[first:last]), short))
    assert "is on no rank" in error or "control points, the knots" in error, error
    moved = vtkStructuredGrid()
    moved.DeepCopy(part)
    if rank == 1:
        moved.GetPoints().SetPoint(0, 9.0, 9.0, 9.0)
    error = errors_of(make_filter(points_data(ROWS[first:last]), moved))
    assert "has another value on one rank than on another" in error, error
    # And it works again.
    algorithm = make_filter(points_data(ROWS[first:last]), part)
    compare(algorithm, ROWS, first, last, net, controller, "cut net again")


def bezier(numbers):
    """Quadratic Bézier curves, one for each number."""
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    grid.Allocate()
    for k in numbers:
        ids = vtkIdList()
        for p in ((0.4 * k, 0, 0.1 * k), (0.4 * k + 0.4, 1, 0), (0.4 * k + 0.2, 1.5, 0.2)):
            ids.InsertNextId(points.InsertNextPoint(p))
        grid.InsertNextCell(VTK_BEZIER_CURVE, ids)
    grid.SetPoints(points)
    weights = numpy_to_vtk(np.linspace(1, 2, 3 * len(numbers)) * 0 + 1.5, deep=True)
    weights.SetName("Weights")
    grid.GetPointData().AddArray(weights)
    grid.GetPointData().SetActiveAttribute("Weights", 9)  # RATIONALWEIGHTS
    faces = numpy_to_vtk(np.array(numbers, dtype=np.int64) // 2, deep=True)
    faces.SetName("FaceId")
    grid.GetCellData().AddArray(faces)
    return grid


def test_bezier_cells(controller):
    ranks = controller.GetNumberOfProcesses()
    first, last = share(COUNT, controller)
    cells = np.array_split(np.arange(6), ranks)[controller.GetLocalProcessId()]
    algorithm = make_filter(points_data(ROWS[first:last]), bezier(cells))
    compare(algorithm, ROWS, first, last, bezier(np.arange(6)), controller, "Bézier cells")


def test_the_model_is_built_once(controller):
    """Scans of several times, a source on one rank: nothing is built or sent again."""
    rank = controller.GetLocalProcessId()
    net = make_net()
    algorithm = make_filter(points_data(ROWS[:1]), net if rank == 0 else vtkStructuredGrid())
    for time_step in range(4):
        rows = ROWS[300 * time_step:300 * (time_step + 1)] + 0.01 * time_step
        first, last = share(len(rows), controller)
        algorithm.SetInputDataObject(0, points_data(rows[first:last]))
        compare(algorithm, rows, first, last, net, controller, f"time {time_step}")
        assert algorithm.GetNumberOfModelBuilds() == 1
    # The same content on other ranks is the same content; other content is not.
    algorithm.SetSourceData(net)
    algorithm.Modified()  # on rank 0 nothing has changed, but where one rank runs, all have to
    compare(algorithm, rows, first, last, net, controller, "on all ranks")
    assert algorithm.GetNumberOfModelBuilds() == 1
    other = make_net(8)
    algorithm.SetSourceData(other if rank == 0 else vtkStructuredGrid())
    compare(algorithm, rows, first, last, other, controller, "other content")
    assert algorithm.GetNumberOfModelBuilds() == 2


def test_errors_on_one_rank(controller):
    ranks = controller.GetNumberOfProcesses()
    rank = controller.GetLocalProcessId()
    net = make_net()
    first, last = share(COUNT, controller)
    part = points_data(ROWS[first:last])
    bad = make_net()
    bad.GetPoints().SetPoint(3, np.nan, 0.0, 0.0)
    cases = [
        ("FixedDirection[0] is not finite", part, net, {"FixedDirection": (np.nan, 0.0, 0.0)}),
        ("control point 3 has the coordinate nan", part, bad, {}),
        ("FirstOrder is for curves alone", part, net, {"Method": 4}),
    ]
    for where in range(ranks):
        for text, points, source, options in cases:
            here = rank == where
            algorithm = make_filter(points, source if here else net, **(options if here else {}))
            error = errors_of(algorithm)
            assert text in error, f"{error!r} instead of {text!r} on rank {rank}"
            if not here:
                # The rank is named, by the message itself or by what it is about.
                assert f"ank {where}" in error, error
            assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() == 0
            assert algorithm.GetOutputDataObject(2).GetNumberOfRows() == 0
            # The same filter works again.
            algorithm = make_filter(points, net)
            compare(algorithm, ROWS, first, last, net, controller, "after an error")
    assert "No geometry" in errors_of(make_filter(part, None))


def test_parametric_functions(controller):
    rank = controller.GetLocalProcessId()
    rows = ROWS[:50]
    first, last = share(len(rows), controller)
    torus = vtkParametricTorus()
    expected = make_filter(points_data(rows), None, serial=True, ParametricFunction=torus)
    expected.Update()
    algorithm = make_filter(points_data(rows[first:last]), None, ParametricFunction=torus)
    assert not errors_of(algorithm)
    same_bits(statistics(algorithm.GetOutput()), statistics(expected.GetOutput()), "torus")
    torus.SetRingRadius(2.0 + rank)
    error = errors_of(algorithm)
    assert ("not the same on all ranks" in error) == (controller.GetNumberOfProcesses() > 1), error
    # A source on any rank goes before functions.
    net = make_net()
    algorithm = make_filter(points_data(rows[first:last]), net if rank == 0 else None,
                            ParametricFunction=torus)
    compare(algorithm, rows, first, last, net, controller, "source before function")


def test_abort_on_one_rank(controller):
    """The others stop, too, within a second, though they would have worked for long."""
    ranks = controller.GetNumberOfProcesses()
    rank = controller.GetLocalProcessId()
    net = make_net()
    generator = np.random.default_rng(rank)
    many = points_data(generator.uniform([-5, -5, -9], [9, 9, 9], (400000, 3)))
    for where in range(ranks):
        algorithm = make_filter(many, net, Search=1, NumberOfSeeds=20)
        told = []

        def stop(caller, _):
            if caller.GetProgress() > 0 and rank == where and not told:
                told.append(time.perf_counter())
                caller.AbortExecuteOn()

        tag = algorithm.AddObserver("ProgressEvent", stop)
        algorithm.Update()
        end = time.perf_counter()
        algorithm.RemoveObserver(tag)
        assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() == 0, "not aborted"
        assert algorithm.GetOutputDataObject(1).GetNumberOfPoints() == 0
        assert rank != where or end - told[0] < 2.0, f"{end - told[0]} s to stop"
        # Nothing of it is left under way: the next run is not stopped.
        algorithm.AbortExecuteOff()
        first, last = share(COUNT, controller)
        algorithm.SetInputDataObject(0, points_data(ROWS[first:last]))
        algorithm.SetSearch(0)
        compare(algorithm, ROWS, first, last, net, controller, "after an abort")


def test_abort_while_building(controller):
    """All ranks stop before the first query, and the next run builds what is missing."""
    rank = controller.GetLocalProcessId()
    first, last = share(COUNT, controller)
    source = blocks(*(make_net(seed, 0.1 * seed) for seed in range(300)))
    for where in range(controller.GetNumberOfProcesses()):
        algorithm = make_filter(points_data(ROWS[first:last]), source)
        told = []

        def stop(caller, _):
            if 0 < caller.GetProgress() < 0.3 and rank == where:
                told.append(caller.GetProgress())
                caller.AbortExecuteOn()

        tag = algorithm.AddObserver("ProgressEvent", stop)
        algorithm.Update()
        algorithm.RemoveObserver(tag)
        assert len(told) == (1 if rank == where else 0), told
        assert rank != where or algorithm.GetNumberOfModelBuilds() == 0
        for port in range(2):
            assert algorithm.GetOutputDataObject(port).GetNumberOfPoints() == 0, "not aborted"
        algorithm.AbortExecuteOff()
        algorithm.Modified()
        compare(algorithm, ROWS, first, last, source, controller, "after an abort")


def test_abort_of_evaluation(controller):
    """A rank that stops ends the evaluation on all of them; those that have no rows are not asked."""
    rank = controller.GetLocalProcessId()
    rows = 200000 if rank == 0 else 10 * rank - 10
    parameters = numpy_to_vtk(np.full((rows, 2), 0.25), deep=True)
    parameters.SetName("Parameters")
    data = points_data(np.zeros((rows, 3)))
    data.GetPointData().AddArray(parameters)
    net = make_net()
    evaluator = footpoint.vtkSplineEvaluator()
    evaluator.SetInputDataObject(0, data)
    evaluator.SetSourceData(net)
    told = []

    def stop(caller, _):
        if 0.3 < caller.GetProgress() < 1:
            told.append(caller.GetProgress())
            caller.AbortExecuteOn()

    tag = evaluator.AddObserver("ProgressEvent", stop)
    evaluator.Update()
    evaluator.RemoveObserver(tag)
    assert len(told) == (1 if rank == 0 else 0), told
    assert evaluator.GetOutput().GetNumberOfPoints() == 0, "not aborted"
    assert evaluator.GetOutput().GetFieldData().GetNumberOfArrays() == 0
    evaluator.AbortExecuteOff()
    evaluator.Modified()
    evaluator.Update()
    assert evaluator.GetOutput().GetNumberOfPoints() == rows


def test_evaluator(controller):
    rank = controller.GetLocalProcessId()
    net = make_net()
    first, last = share(COUNT, controller)
    inversion = make_filter(points_data(ROWS[first:last]), net)
    inversion.Update()
    evaluator = footpoint.vtkSplineEvaluator()
    evaluator.SetInputDataObject(0, inversion.GetOutputDataObject(0))
    evaluator.SetSourceData(net if rank == 0 else vtkStructuredGrid())
    assert not errors_of(evaluator)
    alone = footpoint.vtkSplineEvaluator()
    alone.SetController(None)
    alone.SetInputDataObject(0, inversion.GetOutputDataObject(0))
    alone.SetSourceData(net)
    alone.Update()
    same_bits(point_arrays(evaluator.GetOutput()), point_arrays(alone.GetOutput()), "evaluator")
    skipped = evaluator.GetOutput().GetFieldData().GetArray("NumberOfSkippedPoints").GetValue(0)
    assert skipped == 1, "the one bad point of all ranks"
    evaluator.SetParametersArrayName("None" if rank == 0 else "Parameters")
    evaluator.Modified()  # on all, as on rank 0
    assert "has no array 'None'" in errors_of(evaluator)


def test_ranks_by_themselves(controller):
    """Without a controller, and through the functions for NumPy, ranks need not keep step."""
    rank = controller.GetLocalProcessId()
    net = make_net()
    for _ in range(rank):
        make_filter(points_data(ROWS[:10]), net, serial=True).Update()
        feet = footpoint.invert(ROWS[:10], net)
        assert feet.statistics["count"] == 10
        footpoint.evaluate(net, feet.parameters)


if __name__ == "__main__":
    everything = start()
    run([test for name, test in list(globals().items()) if name.startswith("test_")], everything)
    if "--finalize" in sys.argv:
        everything.Finalize()
