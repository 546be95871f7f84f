# SPDX-License-Identifier: BSD-3-Clause
"""The demo's inspection: kinds of files and what is wrong with them, units, outliers and regions of
known deviations, and a whole inspection whose bend and numbers are known.
"""

import csv
import os
from pathlib import Path
import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import footpoint

ROOT = Path(__file__).resolve().parents[2]
OUTPUT = Path(os.environ.get("FOOTPOINT_TEST_OUTPUT", ".")) / "demo"
sys.path.insert(0, str(ROOT / "Documentation" / "examples"))

from inspection.__main__ import BRACKET, parse, run  # noqa: E402
from inspection.analysis import face_rows, inspect, point_data  # noqa: E402
from inspection.lengths import Lengths, lengths_for, round_up  # noqa: E402
from inspection.output import as_vertices, write_scan, write_vtp  # noqa: E402
from inspection.part import InputError, read_part  # noqa: E402
from inspection.scan import bending, simulate  # noqa: E402
from inspection.scan_files import read_scan  # noqa: E402

POINTS = np.array([[0.5, -1.25, 3.0], [2.0, 4.0, -8.0], [1e-3, 1e3, 0.0]])
ROD = BRACKET.parents[1] / "step" / "linkrods.step"
with_bracket = unittest.skipUnless(
    BRACKET.is_file() and hasattr(footpoint, "vtkCADReader"),
    f"no {BRACKET}" if not BRACKET.is_file() else "built without Open CASCADE")


def write(name, text):
    path = OUTPUT / name
    path.write_text(text, encoding="utf-8")
    return path


def inspect_bracket(*arguments):
    """Runs the demo on the bracket in millimetres."""
    return run(parse([str(BRACKET), *map(str, arguments), "--cad-unit", "m"]))


class ScanFiles(unittest.TestCase):
    def check(self, path, tolerance=0.0):
        np.testing.assert_allclose(read_scan(path), POINTS, rtol=tolerance, atol=0.0)

    def test_kinds(self):
        write_scan(OUTPUT / "scan.ply", POINTS)
        self.check(OUTPUT / "scan.ply", 1e-7)  # single precision
        write_vtp(OUTPUT / "scan.vtp", as_vertices(point_data(POINTS)))
        self.check(OUTPUT / "scan.vtp")
        triangle = point_data(POINTS)
        triangle.AllocateExact(1, 3)
        triangle.InsertNextCell(5, 3, (0, 1, 2))
        writer = vtkSTLWriter()
        writer.SetInputData(triangle)
        writer.SetFileName(str(OUTPUT / "scan.stl"))
        writer.Write()
        self.check(OUTPUT / "scan.stl", 1e-6)  # text of six digits

    def test_texts(self):
        rows = [",".join(f"{x:.17g}" for x in point) for point in POINTS]
        plain = "\n".join(rows)
        self.check(write("plain.csv", plain))
        self.check(write("blanks.xyz", "# a comment\n\n" + plain.replace(",", " \t") + "\n"))
        self.check(write("semicolons.TXT", plain.replace(",", "; ")))
        self.check(write("decimal_commas.csv", "x;y;z\n" + "\n".join(
            row.replace(",", ";").replace(".", ",") for row in rows)))
        self.check(write("colours.xyz", "\n".join(row + ",255,0,0" for row in rows)))
        self.check(write("names.csv", "Point ID,Z,x,Y\n" + "\n".join(
            f"7,{z!r},{x!r},{y!r}" for x, y, z in POINTS.tolist())))
        self.check(write("paraview.csv", '"SignedDistance","Points:0","Points:1","Points:2"\n'
                         + "\n".join("0.5," + row for row in rows)))

    def test_errors(self):
        for path, words in (
                (OUTPUT / "none.ply", "there is no scan .*none.ply"),
                (write("scan.step", "x"), "scan.step is of no known kind.*.ply, .stl"),
                (write("empty.xyz", "# nothing\n"), "no points in .*empty.xyz"),
                (write("broken.ply", "no ply"), "no points in .*broken.ply"),
                (write("names2.csv", "a,b,c\n1,2,3\n"), "columns a, b, c have no x, y and z"),
                (write("short.xyz", "1 2 3\n4 5\n"), "short.xyz, line 2: no three .* in '4 5'"),
                (write("word.csv", "1,2,3\n\n4,five,6\n"), "word.csv, line 3: .*'4 five 6'"),
                (write("blank.csv", ",,\n1,2,3\n"), "the columns , ,  have no x, y and z")):
            with self.subTest(path.name), self.assertRaisesRegex(InputError, words):
                read_scan(path)


class Numbers(unittest.TestCase):
    def test_round_up(self):
        for value, expected in ((0.1, 0.1), (0.11, 0.2), (3.0, 4.0), (9.0, 10.0), (0.0449, 0.05)):
            self.assertAlmostEqual(round_up(value), expected, 12)

    def test_lengths(self):
        lengths = Lengths("mm", 0.05, 0.4, 0.5)
        self.assertEqual(lengths.text(-0.01234), "\u22120.0123 mm")
        self.assertEqual(lengths.signed(1.5, 2), "+1.50 mm")
        self.assertEqual(lengths.point((1.0, -2.346, 0.0)), "(1.00, \u22122.35, 0.00) mm")
        scales = lengths_for("mm", 0.05, np.linspace(-0.3, 0.3, 1001))
        self.assertEqual((scales.colour_limit, scales.histogram_limit), (0.4, 0.5))
        within = lengths_for("mm", 0.05, np.full(100, 0.001))
        self.assertAlmostEqual(within.colour_limit, 0.1, 12)


class Analysis(unittest.TestCase):
    """A plane of 100 x 100 with noise: what is done to the points is what has to be found."""

    def setUp(self):
        self.random = np.random.default_rng(1)
        xy = self.random.uniform(0.0, 100.0, (20000, 2))
        self.points = np.column_stack([xy, self.random.normal(0.0, 0.01, len(xy))])
        self.plane = footpoint.nurbs_surface(
            [[[0, 0, 0], [0, 100, 0]], [[100, 0, 0], [100, 100, 0]]], [0, 0, 1, 1], [0, 0, 1, 1])

    def inspect(self):
        result = footpoint.invert(self.points, self.plane)
        return inspect(self.points, result, 0.1, 1e4)

    def test_all_well(self):
        inspection = self.inspect()
        self.assertFalse(inspection.outliers.any())
        self.assertEqual(inspection.regions, [])
        self.assertAlmostEqual(inspection.noise, 0.01, delta=0.0005)

    def test_outliers(self):
        bad = self.random.choice(len(self.points), 100, replace=False)
        self.points[bad, 2] += self.random.choice((-1.0, 1.0), 100) * self.random.uniform(0.3, 5, 100)
        inspection = self.inspect()
        np.testing.assert_array_equal(np.flatnonzero(inspection.outliers), np.sort(bad))
        self.assertEqual(inspection.regions, [])

    def test_dent_and_bump(self):
        for centre, height in (((30.0, 40.0), -0.5), ((70.0, 60.0), 0.3)):
            way = np.linalg.norm(self.points[:, :2] - centre, axis=1) / 12.0
            self.points[:, 2] += height * np.maximum(0.0, 1.0 - way**2) ** 2
        self.points[0] = [30.0, 40.0, 0.4]  # among dented points one that is not
        inspection = self.inspect()
        np.testing.assert_array_equal(np.flatnonzero(inspection.outliers), [0])
        dent, bump = inspection.regions
        self.assertAlmostEqual(dent.height, -0.5, delta=0.03)
        self.assertAlmostEqual(bump.height, 0.3, delta=0.03)
        np.testing.assert_allclose(dent.position, [30.0, 40.0, 0.0], atol=1.5)
        np.testing.assert_allclose(bump.position, [70.0, 60.0, 0.0], atol=1.5)
        self.assertEqual(dent.faces, [0])
        self.assertFalse(dent.motion.explains or bump.motion.explains)

    def test_motion(self):
        """A lid that is lifted by 0.4 and turned by 1 degree about the x axis."""
        lid = (np.abs(self.points[:, :2] - 50.0) < 15.0).all(axis=1)
        turn = np.radians(1.0)
        self.points[lid, 2] += 0.4 + np.tan(turn) * (self.points[lid, 1] - 50.0)
        region = max(self.inspect().regions, key=lambda r: r.points)
        self.assertTrue(region.motion.explains)
        self.assertAlmostEqual(region.motion.tilt, 1.0, delta=0.1)
        expected = 0.4 + np.tan(turn) * (region.position[1] - 50.0)
        self.assertAlmostEqual(region.motion.shift[2], expected, delta=0.03)
        np.testing.assert_allclose(region.motion.shift[:2], 0.0, atol=1e-9)

    def test_bad_points(self):
        self.points[:3] = [[np.nan, 0, 0], [0, np.inf, 0], [1, 1, 50.0]]
        inspection = self.inspect()
        np.testing.assert_array_equal(np.flatnonzero(inspection.outliers), [2])
        self.assertEqual(inspection.good.sum(), len(self.points) - 3)
        row, none = face_rows(inspection, 2)
        self.assertEqual(row["count"], len(self.points) - 3)
        self.assertIsNone(none)

    def test_bending(self):
        """A bar along x bends across its thinnest direction, and only beyond the stiff part."""
        bar = self.random.uniform([-50, -5, -1], [50, 5, 1], (4000, 3))
        shifts, tip, shift = bending(bar, 0.5)
        self.assertGreater(abs(tip[0]), 49.0)
        self.assertAlmostEqual(abs(shift[2]), 0.5, delta=0.02)
        far = np.sign(tip[0]) * bar[:, 0]
        self.assertTrue((np.abs(shifts[far < 11.0]) < 1e-3).all())
        self.assertGreater(np.abs(shifts[far > 45.0, 2]).min(), 0.3)


@with_bracket
class Bracket(unittest.TestCase):
    """The whole demo."""

    @classmethod
    def setUpClass(cls):
        cls.folder = OUTPUT / "bracket"
        run(parse(["--output", str(cls.folder), "--points-csv"]))
        cls.part = read_part(BRACKET, "mm", "m")
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(cls.folder / "deviation.vtp"))
        reader.Update()
        cls.data = reader.GetOutput()
        cls.points = vtk_to_numpy(cls.data.GetPoints().GetData())
        cls.report = (cls.folder / "report.html").read_text(encoding="utf-8")

    def array(self, name):
        return vtk_to_numpy(self.data.GetPointData().GetArray(name))

    def test_bend_is_found(self):
        """The foot at (0, -65, 14) mm is bent; truth is known for every point."""
        scan = simulate(self.part, 100_000)
        np.testing.assert_array_equal(scan.points, self.points)
        result = footpoint.invert(self.points, self.part.model)
        np.testing.assert_array_equal(result.signed_distance, self.array("SignedDistance"))
        inspection = inspect(self.points, result, 0.1, self.part.area)
        worst = inspection.regions[0]
        self.assertAlmostEqual(worst.height, scan.deviations[scan.worst], delta=2 * scan.noise)
        self.assertLess(np.linalg.norm(worst.position - scan.feet[scan.worst]), 5.0)
        self.assertTrue(worst.motion.explains)
        near = np.linalg.norm(scan.feet - worst.position, axis=1) < 2.0
        up = scan.deviations[near].max()  # the top of the foot faces upwards
        self.assertAlmostEqual(worst.motion.shift[2], up, delta=0.05)
        self.assertAlmostEqual(worst.motion.tilt, 1.0, delta=0.3)  # degrees
        true_outliers = scan.is_outlier & (result.distance > 0.1)
        self.assertGreater((inspection.outliers & true_outliers).sum(), 0.95 * true_outliers.sum())
        self.assertLess((inspection.outliers & ~scan.is_outlier).sum(), 10)
        self.assertIn(f"{worst.height:+.2f} mm", self.report)

    def test_numbers_in_the_report(self):
        good = self.array("Outlier") == 0
        distances = self.array("SignedDistance")[good]
        certified = np.sum(self.array("Status") == footpoint.Status.CERTIFIED)
        self.assertGreater(certified, 0.999 * len(self.points))
        for text in (f"{len(self.points):,}", f"{good.sum():,}", f"{certified:,} certified",
                     f"{np.sqrt(np.mean(distances**2)):.3f} mm", f"{distances.max():+.3f} mm",
                     f"{np.mean(np.abs(distances) > 0.1):.2%}",
                     "taken as m, although it says mm", "data:image/png;base64,"):
            self.assertIn(text, self.report)
        self.assertRegex(self.report, r"open, with [1-9]\d* borders", "it has no underside")

    def test_tables(self):
        with open(self.folder / "faces.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([int(row["face_id"]) for row in rows], list(range(213)))
        good = self.array("Outlier") == 0
        self.assertEqual(sum(int(row["count"]) for row in rows), good.sum())
        face = int(self.array("FaceId")[good][0])
        distances = self.array("SignedDistance")[good & (self.array("FaceId") == face)]
        self.assertAlmostEqual(float(rows[face]["mean"]), distances.mean(), 12)
        with open(self.folder / "points.csv", encoding="utf-8") as file:
            first = next(csv.DictReader(file))
        np.testing.assert_array_equal(
            [float(first[f"Points:{i}"]) for i in range(3)], self.points[0])
        self.assertEqual(float(first["SignedDistance"]), self.array("SignedDistance")[0])

    def test_picture(self):
        reader = vtkPNGReader()
        reader.SetFileName(str(self.folder / "deviation.png"))
        reader.Update()
        image = reader.GetOutput()
        self.assertEqual(image.GetDimensions()[:2], (1600, 900))
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(900, 1600, -1).astype(int)
        front = pixels[330:800, 15:955]  # rows from the bottom
        red = (front[..., 0] - front[..., 2] > 60) & (front[..., 1] < 150)
        yellow = (front[..., 0] - front[..., 2] > 40) & (front[..., 1] - front[..., 2] > 35)
        self.assertGreater(red.sum(), 3000, "the bent foot")
        self.assertGreater(yellow.sum(), 1000, "what was not scanned")

    def test_own_scan_in_inches(self):
        """The same scan in inches: the same numbers, divided by 25.4."""
        path = OUTPUT / "inches.csv"
        np.savetxt(path, self.points[::5] / 25.4, delimiter=",", fmt="%.17g", header="x,y,z",
                   comments="")
        folder = OUTPUT / "inches"
        inspect_bracket(path, "--unit", "inch", "--tolerance", 0.1 / 25.4, "--output", folder)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(folder / "deviation.vtp"))
        reader.Update()
        inches = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("SignedDistance"))
        np.testing.assert_allclose(25.4 * inches, self.array("SignedDistance")[::5], atol=1e-9)
        self.assertFalse((folder / "scan.ply").exists())
        self.assertIn("inch", (folder / "report.html").read_text(encoding="utf-8"))

    def test_closed_solid(self):
        """A STEP file without a scan: the demo bends it and finds the bend, or ends with an error."""
        folder = OUTPUT / "rod"
        run(parse([str(ROD), "--output", str(folder)]))
        report = (folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("closed: deviations are negative inside", report)
        self.assertIn("37, exact and trimmed", report)
        self.assertIn("<td>mm</td>", report)

    def test_errors(self):
        scan = self.folder / "scan.ply"
        for arguments, words in (
                ([OUTPUT / "none.step"], "there is no CAD file .*none.step"),
                ([write("text.step", "some text")], "cannot read .*text.step: "),
                ([BRACKET, OUTPUT / "none.ply"], "there is no scan .*none.ply"),
                ([BRACKET, scan], "scan measures 15.*, the part 0.1614 mm.*--unit.*--cad-unit"),
                ([BRACKET, write("nan.xyz", "nan nan nan\n")], "coordinates that are no numbers")):
            with self.subTest(words), self.assertRaisesRegex(InputError, words):
                run(parse([*map(str, arguments), "--output", str(OUTPUT / "never")]))
        self.assertFalse((OUTPUT / "never").exists())


if __name__ == "__main__":
    OUTPUT.mkdir(parents=True, exist_ok=True)
    unittest.main()
