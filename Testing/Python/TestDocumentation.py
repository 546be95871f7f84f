# SPDX-License-Identifier: BSD-3-Clause
"""The documentation says what the code does: code blocks are the example files, which other tests
run; the README's tables hold every option with its default, array, statistic, status and foot type;
links lead somewhere.
"""

import pathlib
import re
import unittest

import footpoint
from vtkmodules.vtkCommonCore import VTK_DOUBLE_MAX, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *(ROOT / "Documentation").rglob("*.md"),
         *(ROOT / "Data").glob("*.md")]
BLOCK = re.compile(r"(?:<!-- file: (\S+) -->\n)?```(\w+)\n(.*?)\n```", re.DOTALL)
NO_CODE = {"console", "text"}  # what a reader types or sees: no file


def example_text(path):
    """The lines of a file without its licence."""
    lines = (ROOT / path).read_text(encoding="utf-8").rstrip("\n").split("\n")
    return "\n".join(lines[1:] if "SPDX-License-Identifier" in lines[0] else lines)


def table(header):
    """The rows of the README's table with that header row, as lists of cells."""
    rows = README.split(header + "\n", 1)[1].split("\n\n", 1)[0].split("\n")[1:]
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]


def names(header):
    """What stands in code style in the first column of a table."""
    return [name for row in table(header) for name in re.findall(r"`(\w+)`", row[0])]


def run_filter(geometry):
    """The filter's output 0 for one point."""
    points = vtkPoints()
    points.InsertNextPoint(0.1, 0.2, 0.3)
    data = vtkPolyData()
    data.SetPoints(points)
    inversion = footpoint.vtkPointInversionFilter()
    inversion.SetInputData(data)
    inversion.SetSourceData(geometry)
    inversion.Update()
    return inversion.GetOutputDataObject(0)


def array_names(attributes):
    return {attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())}


def members(prefix_enum):
    """{value: CamelCase name} of an IntEnum."""
    return {int(m): m.name.title().replace("_", "") for m in prefix_enum}


class TestCode(unittest.TestCase):
    def test_blocks_are_example_files(self):
        count = 0
        for page in PAGES:
            for path, language, text in BLOCK.findall(page.read_text(encoding="utf-8")):
                if language in NO_CODE:
                    continue
                with self.subTest(page=page.name, file=path):
                    self.assertTrue(path, f"a {language} block without <!-- file: ... -->")
                    self.assertEqual(text, example_text(path))
                    count += 1
        self.assertGreaterEqual(count, 7)

    def test_readme_examples_are_short(self):
        for path, most in (("cad.py", 15), ("invert.cpp", 25)):
            text = example_text("Documentation/examples/" + path)
            self.assertLessEqual(text.count("\n") + 1, most, path)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            prose = BLOCK.sub("", page.read_text(encoding="utf-8"))
            for link in re.findall(r"\]\(([^)\s]+)\)", prose):
                target, _, anchor = link.partition("#")
                with self.subTest(page=page.name, link=link):
                    if not target:
                        self.assertIn(anchor, anchors(prose))
                    elif not target.startswith("https:"):
                        self.assertTrue((page.parent / target).exists(), "no such file")

    def test_every_example_is_listed(self):
        index = (ROOT / "Documentation" / "README.md").read_text(encoding="utf-8")
        folder = ROOT / "Documentation" / "examples"
        for pattern in ("*.py", "*.cpp", "paraview/*.py", "window/pictures.py"):
            for path in folder.glob(pattern):
                self.assertIn(f"(examples/{path.relative_to(folder).as_posix()})", index)


class TestPictures(unittest.TestCase):
    def test_every_picture_is_used_and_small(self):
        pages = "".join(page.read_text(encoding="utf-8") for page in PAGES)
        for path in (ROOT / "Documentation" / "images").rglob("*.png"):
            with self.subTest(picture=path.name):
                name = path.relative_to(ROOT / "Documentation").as_posix()
                self.assertIn(f"({name})", pages.replace("(Documentation/", "("))
                self.assertLess(path.stat().st_size, 200_000)

    def test_pages_are_listed(self):
        index = (ROOT / "Documentation" / "README.md").read_text(encoding="utf-8")
        for page in (ROOT / "Documentation").glob("*.md"):
            if page.name != "README.md":
                self.assertIn(f"]({page.name})", index)


def anchors(text):
    """What GitHub makes of the headings."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class TestTables(unittest.TestCase):
    ARRAYS = "| array | type | meaning |"
    OPTIONS = "| option | default | meaning |"
    STATISTICS = "| field data | meaning |"

    def test_arrays(self):
        surface = run_filter(footpoint.nurbs_surface(
            [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]], [0, 0, 1, 1], [0, 0, 1, 1]))
        curve = run_filter(footpoint.nurbs_curve([[0, 0, 0], [1, 1, 1]], [0, 0, 1, 1]))
        made = array_names(surface.GetPointData()) | array_names(curve.GetPointData())
        self.assertEqual(set(names(self.ARRAYS)), made)
        statistics = array_names(surface.GetFieldData())
        self.assertEqual(set(names(self.STATISTICS)), statistics)

    def test_options_and_defaults(self):
        inversion = footpoint.vtkPointInversionFilter()
        own = vars(footpoint.vtkPointInversionFilter)
        options = {name[3:] for name in own if name.startswith("Set") and "Get" + name[3:] in own}
        # Geometry, in the table of geometries; and the ranks, in the text.
        options -= {"ParametricFunction", "Controller"}
        switches = {option for option in options if option.startswith("Generate")}
        self.assertEqual({"Generate" + name for name in names(self.ARRAYS)}, switches)
        listed = {row[0].strip("`"): row[1] for row in table(self.OPTIONS)}
        self.assertEqual(set(listed) - {"Generate` + array"}, options - switches)
        for option in options - switches:
            with self.subTest(option=option):
                self.assertEqual(listed[option], self.written(inversion, option))
        for switch in switches:
            self.assertTrue(getattr(inversion, "Get" + switch)(), switch)

    @staticmethod
    def written(inversion, option):
        """A default as the README writes it."""
        if hasattr(inversion, f"Get{option}AsString"):
            return getattr(inversion, f"Get{option}AsString")()
        value = getattr(inversion, "Get" + option)()
        if isinstance(value, bool):
            return "on" if value else "off"
        if value == VTK_DOUBLE_MAX:
            return "unlimited"
        if isinstance(value, tuple):
            return " ".join(f"{number:g}" for number in value)
        return f"{value:g}" if isinstance(value, float) else str(value or "(none)")

    def test_enumerations(self):
        for header, enumeration in (("| Status | | meaning |", footpoint.Status),
                                    ("| FootType | | the foot is |", footpoint.FootType)):
            listed = {int(row[0]): row[1] for row in table(header)}
            self.assertEqual(listed, members(enumeration))

    def test_methods_and_searches(self):
        own = vars(footpoint.vtkPointInversionFilter)
        meanings = {row[0].strip("`"): row[2] for row in table(self.OPTIONS)}
        for option in ("Method", "Search"):
            prefix = f"Set{option}To"
            for method in own:
                if method.startswith(prefix):
                    self.assertRegex(meanings[option], rf"\b{method[len(prefix):]}\b")


if __name__ == "__main__":
    unittest.main()
