# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView writes of a pipeline gives the same numbers and colours in a new process: a trace of
what was done, a state as Python, a state file.
"""

import json
import os
from pathlib import Path
import subprocess
import unittest

import numpy as np
from paraview import servermanager, simple, smstate, smtrace
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = Path(__file__).resolve().parents[2] / "Data"
OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"])

#: Runs a script or loads a state file in a process of its own, and tells what is there afterwards.
RUNNER = """
import os, sys
sys.path.insert(0, {folder!r})
from paraview import simple
simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
path = {path!r}
if path.endswith(".pvsm"):
    simple.LoadState(path)
else:
    exec(compile(open(path, encoding="utf-8").read(), path, "exec"), {{}})
import TestTraceAndState
TestTraceAndState.write_summary({summary!r})
view = simple.GetActiveView()
simple.Delete(view)  # its window, before the X connection closes
"""


def make_pipeline():
    """As a user at the window would: two files, a filter, options by name, a picture, a patch."""
    blade = simple.XMLStructuredGridReader(
        registrationName="blade.vts", FileName=[str(DATA / "blade.vts")])
    scan = simple.XMLPolyDataReader(
        registrationName="scan.vtp", FileName=[str(DATA / "scan.vtp")])
    view = simple.CreateView("RenderView")
    inversion = simple.PointInversion(
        registrationName="Deviation", Input=scan, Source=blade, Search="Seeded",
        Method="LevenbergMarquardt", SeedResolution=9, DeviationTolerance=0.05, FlipNormals=1)
    simple.Show(inversion, view)
    simple.Render(view)
    sides = [simple.Line(registrationName=f"Side{k}", Point1=a, Point2=b) for k, (a, b) in
             enumerate(([[0, 0, 0], [2, 0, 0]], [[2, 0, 0], [2, 1, 1]], [[0, 1, 0], [2, 1, 1]],
                        [[0, 1, 0], [0, 0, 0]]))]
    patch = simple.CoonsPatch(
        registrationName="Patch", Input=sides, Resolution=[6, 5], Smoothing="Winslow",
        CellType="Triangles", TriangleStyle="UnionJack")
    simple.Show(patch, view)
    simple.Render(view)


def numbers(data):
    """The points and arrays of a data set as lists, exactly."""
    attributes = data.GetPointData()
    arrays = [attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())]
    result = {array.GetName(): vtk_to_numpy(array) for array in arrays}
    result["points"] = vtk_to_numpy(data.GetPoints().GetData())
    return {name: np.asarray(values, float).ravel().view(np.int64).tolist()
            for name, values in result.items()}


def write_summary(path):
    """Of the pipeline's two filters the options, the numbers and the colour map."""
    summary = {}
    for name in ("Deviation", "Patch"):
        proxy = simple.FindSource(name)
        proxy.UpdatePipeline()
        names = set(proxy.ListProperties()) - {"Input", "Source"}
        summary[name] = {"options": {option: str(getattr(proxy, option)) for option in names},
                         "numbers": numbers(servermanager.Fetch(proxy, 0, idx=0))}
    summary["mesh cells"] = servermanager.Fetch(proxy, 0, idx=1).GetNumberOfPolys()
    summary["colours"] = list(simple.GetColorTransferFunction("SignedDistance").RGBPoints)
    Path(path).write_text(json.dumps(summary), encoding="utf-8")


class SameInANewProcess(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        smtrace.start_trace()
        make_pipeline()
        cls.trace = smtrace.stop_trace()
        cls.state = smstate.get_state()
        simple.SaveState(str(OUTPUT / "trace_state.pvsm"))
        path = OUTPUT / "trace_expected.json"
        write_summary(path)
        cls.expected = json.loads(path.read_text(encoding="utf-8"))
        simple.Delete(simple.GetActiveView())

    def check(self, path):
        summary, runner = path.with_suffix(".json"), path.with_suffix(".run.py")
        summary.unlink(missing_ok=True)
        runner.write_text(RUNNER.format(folder=str(Path(__file__).parent), path=str(path),
                                        summary=str(summary)), encoding="utf-8")
        done = subprocess.run([os.environ["FOOTPOINT_PVPYTHON"], str(runner)], capture_output=True, text=True,
                              timeout=200, check=False)
        self.assertTrue(summary.exists(), done.stdout + done.stderr)
        found = json.loads(summary.read_text(encoding="utf-8"))
        for name in ("Deviation", "Patch"):
            self.assertEqual(found[name]["options"], self.expected[name]["options"])
            for array, values in self.expected[name]["numbers"].items():
                self.assertEqual(found[name]["numbers"][array], values, f"{name}: {array}")
        self.assertEqual(found["mesh cells"], self.expected["mesh cells"])
        np.testing.assert_allclose(found["colours"], self.expected["colours"], rtol=1e-12)

    def test_what_is_expected(self):
        """Or the others would compare nothing."""
        self.assertEqual(len(self.expected["Deviation"]["numbers"]["Distance"]), 2000)
        self.assertEqual(self.expected["Deviation"]["options"]["Method"], "'LevenbergMarquardt'")
        self.assertEqual(self.expected["mesh cells"], 40)
        colours = self.expected["colours"]
        self.assertEqual(colours[0], -colours[-4])
        self.assertLess(colours[0], 0)

    def test_trace(self):
        for line in ("= PointInversion(registrationName='Deviation', Input=scanvtp",
                     ".Search = 'Seeded'", ".Method = 'LevenbergMarquardt'", ".FlipNormals = 1",
                     ".DeviationTolerance = 0.05", ".CellType = 'Triangles'",
                     "= CoonsPatch(registrationName='Patch'", ".TriangleStyle = 'UnionJack'"):
            self.assertIn(line, self.trace)
        path = OUTPUT / "trace.py"
        path.write_text(self.trace, encoding="utf-8")
        self.check(path)

    def test_python_state(self):
        self.assertIn("= PointInversion(registrationName='Deviation'", self.state)
        path = OUTPUT / "trace_state.py"
        path.write_text(self.state, encoding="utf-8")
        self.check(path)

    def test_state_file(self):
        self.check(OUTPUT / "trace_state.pvsm")


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
    unittest.main()
