# SPDX-License-Identifier: BSD-3-Clause
"""The proxies PointInversion and SplineEvaluator: every option reaches the filter, the arrays equal
those of the class itself, and a pipeline survives a Python state and a state file.
"""

import os
from pathlib import Path
import unittest

import numpy as np
from paraview import servermanager, simple, smstate
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLStructuredGridWriter

import footpoint
from footpoint._options import option_names

OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"])
NET = OUTPUT / "proxy_net.vts"
POINTS = OUTPUT / "proxy_points.vtp"

#: A value for every option that is not its default, one run each: not all go together.
OTHER_VALUES = {
    "Search": 1,
    "Method": 2,
    "PointTolerance": 1e-10,
    "CosineTolerance": 1e-6,
    "StepTolerance": 1e-10,
    "CertificateTolerance": 0.0,
    "MaximumIterations": 2,
    "TrustRadius": 0.01,
    "ColumnScaling": 0,
    "IsocurveFallback": 0,
    "SeedResolution": 3,
    "NumberOfSeeds": 1,
    "MaximumDistance": 0.5,
    "OrthogonalOnly": 1,
    "AllFeet": 1,
    "FixedDirection": [0.0, 0.0, 1.0],
    "WarmStart": 1,
    "FlipNormals": 1,
    "DeviationTolerance": 0.25,
    "FootSegments": 1,
    "ArrayNamePrefix": "First",
    "GenerateParameters": 0,
    "GenerateDistance": 0,
    "GenerateSignedDistance": 0,
    "GenerateClosestPoint": 0,
    "GenerateNormal": 0,
    "GenerateTangent": 0,
    "GenerateFaceId": 0,
    "GenerateStatus": 0,
    "GenerateFootType": 0,
    "GenerateIsolated": 0,
    "GenerateIterations": 0,
}


def write(writer, path, data):
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    assert writer.Write() == 1, f"cannot write {path}"


def make_files():
    """A rational surface, and points around it."""
    generator = np.random.default_rng(3)
    u, v = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 4), indexing="ij")
    net = footpoint.nurbs_surface(
        np.stack([u, v, generator.uniform(-0.3, 0.3, u.shape)], axis=-1),
        [0, 0, 0, 0, 0.5, 1, 1, 1, 1],
        [0, 0, 0, 0.5, 1, 1, 1],
        weights=generator.uniform(0.5, 2, u.shape),
    )
    write(vtkXMLStructuredGridWriter(), NET, net)
    coordinates = vtkPoints()
    queries = generator.uniform([-0.5, -0.5, -1], [1.5, 1.5, 1], (60, 3))
    coordinates.SetData(numpy_to_vtk(queries, deep=True))
    points = vtkPolyData()
    points.SetPoints(coordinates)
    write(vtkXMLPolyDataWriter(), POINTS, points)


def arrays_of(data):
    """Every number of a data set or table: {name: array}."""
    result = {}
    if data.IsA("vtkTable"):
        parts = {"row": data.GetRowData()}
    else:
        parts = {"point": data.GetPointData()}
        if data.GetNumberOfPoints() > 0:
            result["points"] = vtk_to_numpy(data.GetPoints().GetData())
    parts["field"] = data.GetFieldData()
    for part, attributes in parts.items():
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(i)
            if array is not None:
                result[f"{part} {array.GetName()}"] = vtk_to_numpy(array)
    return result


def fetch(proxy, port=0):
    """The data of an output, as the filter left it: process 0's, without an append filter."""
    return servermanager.Fetch(proxy, 0, idx=port)


class Base(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        self.points = simple.OpenDataFile(str(POINTS))
        self.net = simple.OpenDataFile(str(NET))

    def inversion(self, **properties):
        return simple.PointInversion(Input=self.points, Source=self.net, **properties)

    def outputs(self, proxy):
        """The numbers of its three outputs."""
        proxy.UpdatePipeline()
        return [arrays_of(fetch(proxy, port)) for port in range(3)]

    def compare(self, outputs, expected, message):
        for port, (arrays, others) in enumerate(zip(outputs, expected)):
            self.assertEqual(set(arrays), set(others), f"{message}, output {port}")
            for name in arrays:
                np.testing.assert_array_equal(
                    arrays[name], others[name], f"{message}, output {port}, {name}"
                )


class Proxies(Base):
    def direct(self, option=None, value=None):
        """The same numbers from the class, without any proxy."""
        points, net = (reader.GetClientSideObject().GetOutputDataObject(0)
                       for reader in (self.points, self.net))
        algorithm = footpoint.vtkPointInversionFilter()
        algorithm.SetInputDataObject(0, points)
        algorithm.SetSourceData(net)
        if option:
            getattr(algorithm, "Set" + option)(value)
        algorithm.Update()
        return [arrays_of(algorithm.GetOutputDataObject(port)) for port in range(3)]

    def test_every_option(self):
        proxy = self.inversion()
        expected = set(option_names(footpoint.vtkPointInversionFilter).values())
        self.assertEqual(expected, set(OTHER_VALUES), "the table of this test has every option")
        self.assertLessEqual(expected, set(proxy.ListProperties()))

        default = self.outputs(proxy)
        self.compare(default, self.direct(), "defaults")
        self.assertEqual(len(default[0]["point Distance"]), 60)
        self.assertEqual(len(default[2]["row FaceId"]), 1)
        for option, value in OTHER_VALUES.items():
            proxy = self.inversion(**{option: value})
            outputs = self.outputs(proxy)
            taken = getattr(proxy.GetClientSideObject(), "Get" + option)()
            np.testing.assert_array_equal(taken, value, option)
            self.compare(outputs, self.direct(option, value), option)

    def test_enumerations_by_name(self):
        proxy = self.inversion(Search="Seeded", Method="LevenbergMarquardt")
        proxy.UpdatePipeline()
        algorithm = proxy.GetClientSideObject()
        self.assertEqual(algorithm.GetSearchAsString(), "Seeded")
        self.assertEqual(algorithm.GetMethodAsString(), "LevenbergMarquardt")
        for name in ("Search", "Method"):
            for value in proxy.GetProperty(name).Available:
                setattr(proxy, name, value)
                proxy.UpdateVTKObjects()
                self.assertEqual(getattr(algorithm, f"Get{name}AsString")(), value)

    def test_inputs(self):
        """Both take other data than that of the readers: composites, and a change of source."""
        group = simple.GroupDatasets(Input=[self.net, self.net])
        proxy = simple.PointInversion(Input=group, Source=group)
        proxy.UpdatePipeline()
        information = proxy.GetDataInformation()
        self.assertEqual(information.GetNumberOfPoints(), 40)
        rows = fetch(proxy, 2)
        self.assertEqual(rows.GetNumberOfRows(), 2, "two faces")
        proxy.Source = self.net
        proxy.UpdatePipeline()
        rows = fetch(proxy, 2)
        self.assertEqual(rows.GetNumberOfRows(), 1, "one face")

    def test_evaluator(self):
        inversion = self.inversion()
        evaluator = simple.SplineEvaluator(Input=inversion, Source=self.net)
        evaluator.UpdatePipeline()
        points = arrays_of(fetch(evaluator))
        # The search evaluates Bézier pieces, the evaluator B-splines: the same but for rounding.
        np.testing.assert_allclose(
            points["points"], points["point ClosestPoint"], rtol=0, atol=1e-14)
        np.testing.assert_array_equal(points["point Clamped"], 0)
        normals = points["point Normal"]
        evaluator.FlipNormals = 1
        evaluator.UpdatePipeline()
        flipped = arrays_of(fetch(evaluator))["point Normal"]
        np.testing.assert_array_equal(flipped, -normals)

        renamed = self.inversion(ArrayNamePrefix="My")
        evaluator = simple.SplineEvaluator(
            Input=renamed, Source=self.net, ParametersArrayName="MyParameters",
            FaceIdArrayName="MyFaceId")
        evaluator.UpdatePipeline()
        named = arrays_of(fetch(evaluator))
        np.testing.assert_array_equal(named["points"], points["points"])


class States(Base):
    """A pipeline that was saved and read again gives the same numbers."""

    def setUp(self):
        super().setUp()
        proxy = self.inversion(Search="Seeded", SeedResolution=5, FlipNormals=1, TrustRadius=0.25)
        simple.RenameSource("Saved", proxy)
        self.before = self.outputs(proxy)

    def check(self):
        restored = simple.FindSource("Saved")
        self.assertIsNotNone(restored)
        self.assertEqual(restored.Search, "Seeded")
        self.assertEqual(restored.TrustRadius, 0.25)
        self.compare(self.outputs(restored), self.before, "restored")

    def test_python_state(self):
        state = smstate.get_state()
        self.assertIn("PointInversion(", state)
        simple.ResetSession()
        self.assertIsNone(simple.FindSource("Saved"))
        exec(compile(state, "state.py", "exec"), {})
        self.check()

    def test_state_file(self):
        path = str(OUTPUT / "proxy_state.pvsm")
        simple.SaveState(path)
        simple.ResetSession()
        self.assertIsNone(simple.FindSource("Saved"))
        simple.LoadState(path)
        self.check()


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    make_files()
    unittest.main()
