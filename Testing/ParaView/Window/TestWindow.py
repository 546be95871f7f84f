# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in ParaView's window: menus, the dialog of two inputs, Apply, colours, undo and redo,
tooltips and help. Documentation/examples/window/start.py runs this.
"""

import os
from pathlib import Path
import re
import subprocess
import sys
import unittest

import numpy as np
from paraview import servermanager, simple, smtrace
from PyQt5.QtWidgets import QLabel, QTextBrowser
from vtkmodules.util.numpy_support import vtk_to_numpy

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "Testing" / "Python"))

from proxies import options, proxies, text  # noqa: E402
import window  # noqa: E402

DATA = ROOT / "Data"
PART = Path("/usr/share/opencascade/data/step/linkrods.step")  # of Debian's Open CASCADE
OUTPUT = Path(os.environ["FOOTPOINT_TEST_OUTPUT"])

#: The trace begins when view and files are there, and finds them by name.
AROUND_TRACE = """
import os
import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
simple.LoadPlugin(os.environ["FOOTPOINT_PLUGIN"], remote=False, ns=vars(simple))
view = simple.CreateView("RenderView", registrationName="RenderView1")
simple.AssignViewToLayout(view=view, layout=simple.CreateLayout())
simple.XMLStructuredGridReader(FileName=["{data}/blade.vts"], registrationName="blade.vts")
simple.XMLPolyDataReader(FileName=["{data}/scan.vtp"], registrationName="scan.vtp")
{trace}
data = simple.servermanager.Fetch(simple.FindSource("PointInversion1"), 0, idx=0)
numpy.save("{result}", vtk_to_numpy(data.GetPointData().GetArray("SignedDistance")))
simple.Delete(simple.GetActiveView())
"""


def fetch(proxy, name):
    """From the filter itself: servermanager.Fetch would be a step that Undo undoes."""
    data = proxy.GetClientSideObject().GetOutputDataObject(0)
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def centres(mesh):
    """Of the triangles of a mesh."""
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(mesh.GetPoints().GetData())[corners].mean(axis=1)


def shown_ports(source):
    """The outputs of a source that the view shows."""
    inputs = [r.SMProxy.GetProperty("Input") for r in simple.GetActiveView().Representations
              if r.GetProperty("Input") is not None and r.Visibility]
    return sorted(p.GetOutputPortForConnection(0) for p in inputs
                  if p.GetProxy(0) is source.SMProxy)


class Window(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        window.settle()
        self.panel = window.Panel()
        simple.XMLStructuredGridReader(
            FileName=[str(DATA / "blade.vts")], registrationName="blade.vts")
        self.scan = simple.XMLPolyDataReader(
            FileName=[str(DATA / "scan.vtp")], registrationName="scan.vtp")
        simple.SetActiveSource(self.scan)
        window.settle()

    def invert(self):
        """Point Inversion by the menu and the dialog, not yet applied."""
        action = window.menu("Filters", "Footpoint", "Point Inversion")
        window.with_dialog(action.trigger, lambda dialog: window.answer_inputs(
            dialog, {"Input": "scan.vtp", "Source": "blade.vts"}))
        window.settle()
        return simple.GetActiveSource()

    def test_menus(self):
        """Every filter and source is in the category, readers are not."""
        expected = {"filters": set(), "sources": set()}
        for name, proxy in proxies().items():
            if proxy.find("Hints/ShowInMenu") is not None and \
                    proxy.find("Hints/ReaderFactory") is None:
                group = "sources" if hasattr(servermanager.sources, name) and \
                    not hasattr(servermanager.filters, name) else "filters"
                expected[group].add(proxy.get("label"))
        self.assertGreaterEqual(len(expected["filters"]), 9)
        self.assertLessEqual({"Spline Tessellator", "Bezier Extraction"}, expected["filters"])
        self.assertIn("NURBS Shape Source", expected["sources"])
        self.assertEqual(set(window.labels("Filters", "Footpoint")), expected["filters"])
        self.assertEqual(set(window.labels("Sources", "Footpoint")), expected["sources"])

    def shape(self):
        """The default of Sources > Footpoint > NURBS Shape Source, a sphere: its net."""
        window.menu("Sources", "Footpoint", "NURBS Shape Source").trigger()
        window.settle()
        shape = simple.GetActiveSource()
        self.assertEqual(shape.GetXMLName(), "NURBSShapeSource")
        self.panel.apply()
        return shape

    def make(self, label):
        """A filter of the active source by the menu, applied."""
        window.menu("Filters", "Footpoint", label).trigger()
        window.settle()
        self.panel.apply()
        return simple.GetActiveSource()

    def display(self, source):
        return simple.GetDisplayProperties(source, simple.GetActiveView())

    def test_shape_is_shown_as_net(self):
        """As lines, not as if the net were the surface, and the panel says so."""
        shape = self.shape()
        self.assertEqual(shown_ports(shape), [0])
        self.assertEqual(self.display(shape).Representation, "Wireframe")
        said = " ".join(label.text() for label in self.panel.widget.findChildren(QLabel)
                        if label.isVisible())
        self.assertIn("Spline Tessellator", said)

    def test_shape_as_triangles(self):
        """Spline Tessellator shows the sphere in place of its net."""
        shape = self.shape()
        mesh = self.make("Spline Tessellator")
        self.assertEqual(mesh.GetXMLName(), "SplineTessellator")
        self.assertEqual((shown_ports(shape), shown_ports(mesh)), ([], [0]))
        self.assertEqual(self.display(mesh).Representation, "Surface")
        coarse = mesh.GetDataInformation().GetNumberOfCells()
        self.panel.set("ChordTolerance", 1e-5)
        self.panel.apply()
        self.assertGreater(mesh.GetDataInformation().GetNumberOfCells(), 20 * coarse)
        triangles = mesh.GetClientSideObject().GetOutputDataObject(0)
        tolerance = 1e-5 * 2 * 3**0.5  # of the diagonal of the net's box
        self.assertGreater(np.linalg.norm(centres(triangles), axis=1).min(), 1.0 - tolerance)

    def test_shape_as_bezier_cells(self):
        """Nonlinear Subdivision Level, an advanced option of the display, makes cells smooth."""
        self.shape()
        cells = self.make("Bezier Extraction")
        display = self.display(cells)
        self.assertEqual(display.Representation, "Surface")
        self.panel.show_advanced()
        self.panel.set("NonlinearSubdivisionLevel", 4)
        self.panel.show_advanced(False)
        self.assertEqual(display.NonlinearSubdivisionLevel, 4)
        simple.Render()
        drawn = display.GetRepresentedDataInformation()
        self.assertGreater(drawn.GetNumberOfCells(), 1000)

    def test_open_cad_file(self):
        """File > Open knows the extension; Apply shows the mesh and the edges, not control nets."""
        if not PART.exists() or not hasattr(simple, "CADReader"):
            self.skipTest(f"no {PART}, or built without Open CASCADE")
        window.with_dialog(window.menu("File", "Open...").trigger,
                           lambda dialog: window.answer_file(dialog, PART))
        window.settle()
        reader = simple.GetActiveSource()
        self.assertEqual(reader.GetXMLName(), "CADReader")
        self.panel.apply()
        self.assertEqual(shown_ports(reader), [0, 2])

    def test_inputs_apply_and_colours(self):
        proxy = self.invert()
        self.assertEqual(proxy.Input.GetXMLName(), "XMLPolyDataReader")
        self.assertEqual(proxy.Source.GetXMLName(), "XMLStructuredGridReader")
        self.panel.apply()
        view = simple.GetActiveView()
        display = simple.GetDisplayProperties(proxy, view)
        self.assertTrue(display.Visibility)
        self.assertEqual(list(display.ColorArrayName), ["POINTS", "SignedDistance"])
        self.check_colours(proxy)
        legend = simple.GetScalarBar(display.LookupTable, view)
        self.assertTrue(legend.Visibility)
        self.assertEqual([v.GetXMLName() for v in simple.GetViews()], ["RenderView"])
        self.assertEqual(shown_ports(proxy), [0], "the points alone")
        self.assertEqual(legend.Title, "SignedDistance")

    def test_colours_after_another_apply(self):
        """The map stays symmetric while it grows; here about threefold, along z."""
        proxy = self.invert()
        self.panel.apply()
        before = self.check_colours(proxy)
        self.panel.set("FixedDirection", [0, 0, 1])
        self.panel.apply()
        display = simple.GetDisplayProperties(proxy, simple.GetActiveView())
        points = list(display.LookupTable.RGBPoints)
        largest = np.nanmax(np.abs(fetch(proxy, "SignedDistance")))
        self.assertGreater(largest, 2 * before)
        self.assertEqual((points[0], points[-4]), (-largest, largest))

    def check_colours(self, proxy):
        """The range of the map is ± the largest distance, which is returned."""
        display = simple.GetDisplayProperties(proxy, simple.GetActiveView())
        points = np.reshape(list(display.LookupTable.RGBPoints), (-1, 4))
        largest = np.abs(fetch(proxy, "SignedDistance")).max()
        self.assertEqual((points[0, 0], points[1, 0], points[2, 0]), (-largest, 0.0, largest))
        return largest

    def test_undo_and_redo_of_a_property(self):
        proxy = self.invert()
        self.panel.apply()
        distances = fetch(proxy, "SignedDistance").copy()
        self.panel.set("FlipNormals", True)
        self.panel.apply()
        np.testing.assert_array_equal(fetch(proxy, "SignedDistance"), -distances)
        self.step("Undo Apply")
        self.assertEqual(proxy.FlipNormals, 0)
        proxy.UpdatePipeline()
        np.testing.assert_array_equal(fetch(proxy, "SignedDistance"), distances)
        self.step("Redo Apply")
        self.assertEqual(proxy.FlipNormals, 1)
        proxy.UpdatePipeline()
        np.testing.assert_array_equal(fetch(proxy, "SignedDistance"), -distances)

    def test_undo_and_redo_of_the_filter(self):
        before = set(simple.GetSources())
        proxy = self.invert()
        self.panel.apply()
        distances = fetch(proxy, "SignedDistance").copy()
        del proxy
        self.step("Undo Apply")
        self.step("Undo Create 'PointInversion'")
        self.assertEqual(set(simple.GetSources()), before)
        self.step("Redo Create 'PointInversion'")
        again = simple.FindSource("PointInversion1")
        self.assertIsNotNone(again)
        again.UpdatePipeline()
        np.testing.assert_array_equal(fetch(again, "SignedDistance"), distances)

    def step(self, label):
        """Undo or redo, which must be of that."""
        window.menu("Edit", label).trigger()
        window.settle()

    def test_trace(self):
        """What Tools > Start Trace records runs in pvpython, to the same numbers."""
        smtrace.start_trace()
        proxy = self.invert()
        self.panel.apply()
        self.panel.set("Search", "Seeded")
        self.panel.set("FlipNormals", True)
        self.panel.apply()
        trace = smtrace.stop_trace()
        self.assertIn("= PointInversion(registrationName='PointInversion1'", trace)
        self.assertIn("pointInversion1.Search = 'Seeded'", trace)
        self.assertIn("pointInversion1.FlipNormals = 1", trace)
        script, result = OUTPUT / "window_trace.py", OUTPUT / "window_trace.npy"
        script.write_text(AROUND_TRACE.format(
            data=str(DATA), trace=trace, result=str(result)), encoding="utf-8")
        result.unlink(missing_ok=True)
        done = subprocess.run([os.environ["FOOTPOINT_PVPYTHON"], str(script)], timeout=200,
                              capture_output=True, text=True, check=False)
        self.assertTrue(result.exists(), done.stdout + done.stderr)
        np.testing.assert_array_equal(np.load(result), fetch(proxy, "SignedDistance"))

    def test_tooltips(self):
        """The words of the XML are shown at the widgets."""
        self.invert()
        self.panel.show_advanced()
        for name, element in options(proxies()["PointInversion"]).items():
            tip = re.sub(r"<[^>]*>", "", self.panel.option(name).toolTip())
            self.assertEqual(" ".join(tip.split()), text(element), name)
        self.panel.show_advanced(False)

    def test_help(self):
        """The help button shows the page made of the XML."""
        self.invert()
        self.panel.button("Help").click()

        def page():
            browsers = [b for w in window.visible("pqHelpWindow")
                        for b in w.findChildren(QTextBrowser)]
            return next((b.toPlainText() for b in browsers if "Point Inversion" in b.toPlainText()),
                        None)

        shown = " ".join(window.wait(page, "the page of Point Inversion").split())
        self.assertIn(text(proxies()["PointInversion"]), shown)
        self.assertIn(text(options(proxies()["PointInversion"])["MaximumDistance"]), shown)
        for help_window in window.visible("pqHelpWindow"):
            help_window.close()


if __name__ == "__main__":
    window.main_window().resize(1400, 1000)
    unittest.main()
