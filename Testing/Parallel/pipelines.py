# SPDX-License-Identifier: BSD-3-Clause
"""ParaView pipelines with points and geometry of every kind of producer; what they give on any number
of ranks equals, bit for bit, what the class gives in one process.
"""

import os
from pathlib import Path

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkIOXML import (
    vtkXMLMultiBlockDataWriter, vtkXMLPolyDataWriter, vtkXMLStructuredGridWriter)

import footpoint
from ranks import point_arrays, points_data, same_bits, statistics, table_rows

OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"])
RANKS = int(os.environ["FOOTPOINT_RANKS"])
STEP_FILE = Path(os.environ["FOOTPOINT_SHARED_DATA"]) / "cad" / "ubend2.stp"
OURS = {"Parameters", "Distance", "SignedDistance", "ClosestPoint", "Normal", "FaceId", "Status",
        "FootType", "Isolated", "Iterations", "Tangent"}


def make_net(seed=3, shift=0.0):
    generator = np.random.default_rng(seed)
    u, v = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 4), indexing="ij")
    return footpoint.nurbs_surface(
        np.stack([u + shift, v, generator.uniform(-0.3, 0.3, u.shape)], axis=-1),
        [0, 0, 0, 0, 0.5, 1, 1, 1, 1],
        [0, 0, 0, 0.5, 1, 1, 1],
        weights=generator.uniform(0.5, 2, u.shape),
    )


def queries(count, seed):
    return np.random.default_rng(seed).uniform([-0.5, -0.5, -1], [1.5, 1.5, 1], (count, 3))


def write(writer, name, data):
    path = OUTPUT / f"ranks{RANKS}_{name}"
    writer.SetFileName(str(path))
    writer.SetInputDataObject(data)
    assert writer.Write() == 1, f"cannot write {path}"
    return str(path)


def write_pieces(rows, count):
    """A .pvtp file of so many pieces, which the ranks share out."""
    names = [Path(write(vtkXMLPolyDataWriter(), f"piece{k}.vtp", points_data(part))).name
             for k, part in enumerate(np.array_split(rows, count))]
    pieces = "".join(f'<Piece Source="{name}"/>' for name in names)
    path = OUTPUT / f"ranks{RANKS}_pieces.pvtp"
    path.write_text(
        '<VTKFile type="PPolyData" version="0.1"><PPolyData GhostLevel="0"><PPoints>'
        '<PDataArray type="Float64" Name="Points" NumberOfComponents="3"/></PPoints>'
        f"{pieces}</PPolyData></VTKFile>")
    return str(path)


class Files:
    """Points and nets on disk, and what is in them."""

    _written = None

    @classmethod
    def written(cls):
        cls._written = cls._written or cls()
        return cls._written

    def __init__(self):
        self.net = make_net()
        self.net_file = write(vtkXMLStructuredGridWriter(), "net.vts", self.net)
        self.other = make_net(8, 1.2)
        model = vtkMultiBlockDataSet()
        model.SetBlock(0, self.net)
        model.SetBlock(2, self.other)
        self.model_file = write(vtkXMLMultiBlockDataWriter(), "model.vtm", model)
        self.model = model
        self.rows = queries(300, 1)
        self.points_file = write(vtkXMLPolyDataWriter(), "points.vtp", points_data(self.rows))
        self.pieces_file = write_pieces(self.rows, 5)
        blocks = vtkMultiBlockDataSet()
        for k in range(3):
            if k != 1:
                blocks.SetBlock(k, points_data(queries(50 + k, 10 + k)))
        self.blocks_file = write(vtkXMLMultiBlockDataWriter(), "blocks.vtm", blocks)
        self.scans = [
            write(vtkXMLPolyDataWriter(), f"scan{k}.vtp", points_data(queries(80 + 10 * k, 20 + k)))
            for k in range(3)]


def leaves(data):
    """The data sets in it that have points."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data] if data.GetNumberOfPoints() > 0 else []
    result = []
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        if iterator.GetCurrentDataObject().GetNumberOfPoints() > 0:
            result.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return result


def is_satellite():
    """Whether this is not the first of the ranks that run this program."""
    return vtkMultiProcessController.GetGlobalController().GetLocalProcessId() > 0


def check(proxy, source, what, count=None, time=None):
    """Compares the outputs of a PointInversion, fetched from all ranks, with those of one process.

    \\param source the whole geometry
    \\param count how many points all ranks together have
    """
    proxy.UpdatePipeline(time)
    # Every rank fetches where every rank runs this program; the first gets the data.
    fetched = leaves(servermanager.Fetch(proxy))
    first_rank = servermanager.Fetch(proxy, 0)
    feet = sum(leaf.GetNumberOfPoints() for leaf in leaves(servermanager.Fetch(proxy, idx=1)))
    faces = table_rows(servermanager.Fetch(proxy, idx=2))
    if is_satellite():
        return proxy

    coordinates = np.concatenate([point_positions(leaf) for leaf in fetched])
    assert count is None or len(coordinates) == count, f"{what}: {len(coordinates)} points"
    expected = footpoint.vtkPointInversionFilter()
    expected.SetController(None)
    expected.SetInputDataObject(0, points_data(coordinates))
    expected.SetSourceData(source)
    expected.Update()
    whole = point_arrays(expected.GetOutput())
    first = 0
    for leaf in fetched:
        arrays = {n: a for n, a in point_arrays(leaf).items() if n in OURS}
        last = first + leaf.GetNumberOfPoints()
        same_bits(arrays, {n: a[first:last] for n, a in whole.items()}, what)
        first = last
    assert feet == np.sum(whole["Status"] != 3) - np.sum(whole["Status"] == 4), f"{what}: {feet}"

    # The fields of every rank are the same, so the first rank's are everybody's.
    whole_statistics = statistics(expected.GetOutput())
    algorithm = proxy.GetClientSideObject()
    if algorithm:
        own = statistics(algorithm.GetOutputDataObject(0))
        same_bits({n: own[n] for n in whole_statistics}, whole_statistics, f"{what}, statistics")
    else:  # the server sends numbers of a rank without points as text
        own = statistics(first_rank)
        for name, numbers in whole_statistics.items():
            np.testing.assert_allclose(own[name], numbers, rtol=1e-8, err_msg=f"{what}, {name}")

    # Each face once, whatever the number of ranks. The names of blocks are those of readers here.
    whole_faces = table_rows(expected.GetOutputDataObject(2))
    del faces["Name"], whole_faces["Name"]
    assert faces == whole_faces, f"{what}, table: {faces}, {whole_faces}"
    return proxy


def point_positions(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def only_rank(rank, body):
    """A script of a programmable source that runs its body on one rank only."""
    return (
        "from vtkmodules.vtkParallelCore import vtkMultiProcessController\n"
        "controller = vtkMultiProcessController.GetGlobalController()\n"
        f"if controller is None or controller.GetLocalProcessId() == {rank}:\n"
        + "\n".join("    " + line for line in body.splitlines()))


READ_NET = """from vtkmodules.vtkIOXML import vtkXMLStructuredGridReader
reader = vtkXMLStructuredGridReader()
reader.SetFileName({path!r})
reader.Update()
self.GetOutputDataObject(0).ShallowCopy(reader.GetOutput())
"""

READ_POINTS = """from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
reader = vtkXMLPolyDataReader()
reader.SetFileName({path!r})
reader.Update()
self.GetOutputDataObject(0).ShallowCopy(reader.GetOutput())
"""


def test_readers(_):
    files = Files.written()
    net = simple.OpenDataFile(files.net_file)
    for path, count in ((files.points_file, 300), (files.pieces_file, 300),
                        (files.blocks_file, 102)):
        points = simple.OpenDataFile(path)
        check(simple.PointInversion(Input=points, Source=net), files.net, Path(path).name, count)
    model = simple.OpenDataFile(files.model_file)
    points = simple.OpenDataFile(files.pieces_file)
    check(simple.PointInversion(Input=points, Source=model), files.model, "model", 300)


def test_step_file(_):
    files = Files.written()
    if not hasattr(simple, "CADReader") or not STEP_FILE.exists():
        print("without a CAD reader or the file: left out", flush=True)
        return
    reader = simple.CADReader(FileName=str(STEP_FILE))
    model = footpoint.read_cad(str(STEP_FILE))
    points = simple.OpenDataFile(files.pieces_file)
    check(simple.PointInversion(Input=points, Source=simple.OutputPort(reader, 1)), model, "STEP",
          300)


def test_distributed_producers(_):
    files = Files.written()
    net = simple.OpenDataFile(files.net_file)
    sphere = simple.Sphere(ThetaResolution=24, PhiResolution=16)
    check(simple.PointInversion(Input=sphere, Source=net), files.net, "sphere")
    wavelet = simple.Wavelet(WholeExtent=[-3, 3, -3, 3, -3, 3])
    surface = simple.Transform(Input=simple.ExtractSurface(Input=wavelet), Transform="Transform")
    surface.Transform.Scale = [0.2, 0.2, 0.2]
    check(simple.PointInversion(Input=surface, Source=net), files.net, "surface of a grid")


def test_source_on_one_rank(_):
    files = Files.written()
    points = simple.OpenDataFile(files.pieces_file)
    for rank in range(RANKS):
        source = simple.ProgrammableSource(OutputDataSetType="vtkStructuredGrid")
        source.Script = only_rank(rank, READ_NET.format(path=files.net_file))
        inversion = simple.PointInversion(Input=points, Source=source)
        check(inversion, files.net, f"source on rank {rank}", 300)


def test_points_on_one_rank(_):
    files = Files.written()
    net = simple.OpenDataFile(files.net_file)
    source = simple.ProgrammableSource(OutputDataSetType="vtkPolyData")
    source.Script = only_rank(RANKS - 1, READ_POINTS.format(path=files.points_file))
    inversion = check(simple.PointInversion(Input=source, Source=net), files.net, "one rank", 300)
    evaluator = simple.SplineEvaluator(Input=inversion, Source=net)
    evaluator.UpdatePipeline()
    evaluated = servermanager.Fetch(evaluator).GetNumberOfPoints()
    assert is_satellite() or evaluated == 300, f"{evaluated} of 300 points"


def test_time_steps(_):
    """A series of scans against a net that is read once."""
    files = Files.written()
    scans = simple.XMLPolyDataReader(FileName=files.scans)
    net = simple.OpenDataFile(files.net_file)
    inversion = simple.PointInversion(Input=scans, Source=net)
    assert list(scans.TimestepValues) == [0.0, 1.0, 2.0], list(scans.TimestepValues)
    for time in (0.0, 1.0, 2.0, 1.0):
        check(inversion, files.net, f"time {time}", 80 + 10 * int(time), time)
        algorithm = inversion.GetClientSideObject()
        builds = algorithm.GetNumberOfModelBuilds() if algorithm else None
        assert builds in (1, None), f"{builds} builds"


def test_many_kinds_of_composites(_):
    files = Files.written()
    group = simple.GroupDatasets(Input=[simple.OpenDataFile(files.pieces_file),
                                        simple.OpenDataFile(files.points_file)])
    net = simple.OpenDataFile(files.net_file)
    check(simple.PointInversion(Input=group, Source=net), files.net, "collection", 600)
    two = simple.GroupDatasets(Input=[net, net])
    points = simple.OpenDataFile(files.pieces_file)
    model = vtkMultiBlockDataSet()
    model.SetBlock(0, files.net)
    model.SetBlock(1, files.net)
    check(simple.PointInversion(Input=points, Source=two), model, "group of nets", 300)


def all_tests():
    return [test for name, test in globals().items() if name.startswith("test_")]
