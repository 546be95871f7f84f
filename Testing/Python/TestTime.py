# SPDX-License-Identifier: BSD-3-Clause
"""Points and geometry that change with time: results of the time that is asked for, a search
structure that is built only where the geometry changes, statistics of each time step.
"""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

import footpoint


class Series(VTKPythonAlgorithmBase):
    """A source that has time steps and makes its data of the time asked for."""

    def __init__(self, times, data_type, make):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType=data_type)
        self.times = times
        self.make = make
        self.runs = 0

    def RequestInformation(self, _, __, outputs):
        info = outputs.GetInformationObject(0)
        if self.times:
            info.Set(Pipeline.TIME_STEPS(), self.times, len(self.times))
            info.Set(Pipeline.TIME_RANGE(), [self.times[0], self.times[-1]], 2)
        return 1

    def RequestData(self, _, __, outputs):
        info = outputs.GetInformationObject(0)
        time = info.Get(Pipeline.UPDATE_TIME_STEP()) if info.Has(Pipeline.UPDATE_TIME_STEP()) else 0
        data = self.make(time)
        output = self.GetOutputDataObject(0)
        output.ShallowCopy(data)
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        self.runs += 1
        return 1


def square(height):
    points = np.array([[[0, 0, height], [0, 1, height]], [[1, 0, height], [1, 1, height]]], float)
    return footpoint.nurbs_surface(points, [0, 0, 1, 1], [0, 0, 1, 1])


def scan(time):
    """Points at height 2 + time, 10 more at each step."""
    count = 10 + 10 * int(time)
    rows = np.full((count, 3), 0.5)
    rows[:, 2] = 2 + time
    points = vtkPoints()
    points.SetData(numpy_to_vtk(rows, deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    return data


def blocks_of_scans(time):
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, scan(time))
    blocks.SetBlock(2, scan(time + 1))
    return blocks


def run(algorithm, time):
    algorithm.UpdateTimeStep(time)
    fields = algorithm.GetOutputDataObject(0).GetFieldData()
    return {name: fields.GetArray(name).GetValue(0)
            for name in ("DistanceCount", "DistanceMean", "DistanceMaximum")}


class Time(unittest.TestCase):
    def filter(self, points, source):
        algorithm = footpoint.vtkPointInversionFilter()
        algorithm.SetInputConnection(0, points.GetOutputPort())
        algorithm.SetSourceConnection(source.GetOutputPort())
        return algorithm

    def times(self, algorithm):
        algorithm.UpdateInformation()
        info = algorithm.GetOutputInformation(0)
        return list(info.Get(Pipeline.TIME_STEPS())) if info.Has(Pipeline.TIME_STEPS()) else []

    def test_scans_against_a_static_net(self):
        points = Series([0.0, 1.0, 2.0], "vtkPolyData", scan)
        net = Series([], "vtkStructuredGrid", lambda _: square(0.0))
        algorithm = self.filter(points, net)
        self.assertEqual(self.times(algorithm), [0, 1, 2])
        for time in (0.0, 1.0, 2.0, 1.0):
            result = run(algorithm, time)
            self.assertEqual(result["DistanceCount"], 10 + 10 * time)
            self.assertEqual(result["DistanceMean"], 2 + time)
            self.assertEqual(algorithm.GetNumberOfModelBuilds(), 1)
        # A source that ran again, with the same content.
        net.Modified()
        run(algorithm, 2.0)
        self.assertGreater(net.runs, 1)
        self.assertEqual(algorithm.GetNumberOfModelBuilds(), 1)

    def test_blocks_of_scans(self):
        points = Series([0.0, 1.0], "vtkMultiBlockDataSet", blocks_of_scans)
        net = Series([], "vtkStructuredGrid", lambda _: square(0.0))
        algorithm = self.filter(points, net)
        for time in (0.0, 1.0):
            result = run(algorithm, time)
            self.assertEqual(result["DistanceCount"], 30 + 20 * time)
            self.assertEqual(result["DistanceMaximum"], 3 + time)
        self.assertEqual(algorithm.GetNumberOfModelBuilds(), 1)

    def test_moving_net(self):
        points = Series([], "vtkPolyData", lambda _: scan(0))
        net = Series([0.0, 0.5, 1.0], "vtkStructuredGrid", square)
        algorithm = self.filter(points, net)
        self.assertEqual(self.times(algorithm), [0, 0.5, 1])
        for builds, time in enumerate((0.0, 0.5, 1.0), start=1):
            self.assertEqual(run(algorithm, time)["DistanceMean"], 2 - time)
            self.assertEqual(algorithm.GetNumberOfModelBuilds(), builds)
        evaluator = footpoint.vtkSplineEvaluator()
        evaluator.SetInputConnection(0, algorithm.GetOutputPort())
        evaluator.SetSourceConnection(net.GetOutputPort())
        for time in (0.0, 1.0, 0.5):
            evaluator.UpdateTimeStep(time)
            self.assertEqual(evaluator.GetOutput().GetPoint(0), (0.5, 0.5, time))

    def test_both_move(self):
        points = Series([0.0, 1.0], "vtkPolyData", scan)
        net = Series([0.0, 0.5, 1.0], "vtkStructuredGrid", square)
        algorithm = self.filter(points, net)
        self.assertEqual(self.times(algorithm), [0, 0.5, 1])
        for time in (0.0, 1.0):
            self.assertEqual(run(algorithm, time)["DistanceMean"], 2.0)


if __name__ == "__main__":
    unittest.main()
