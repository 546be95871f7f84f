# SPDX-License-Identifier: BSD-3-Clause
"""One default everywhere: what the classes return, ParaView's XML, the headers' and Python's words."""

import ast
import inspect
from pathlib import Path
import re
import unittest
import xml.etree.ElementTree as ElementTree

import footpoint
from footpoint._options import option_names

ROOT = Path(__file__).resolve().parents[2]
CLASSES = {
    "PointInversion": footpoint.vtkPointInversionFilter,
    "SplineEvaluator": footpoint.vtkSplineEvaluator,
    "SplineFileReader": footpoint.vtkSplineReader,
    "SplineFileWriter": footpoint.vtkSplineWriter,
}
if hasattr(footpoint, "vtkCADReader"):  # not without Open CASCADE
    CLASSES["CADReader"] = footpoint.vtkCADReader


def defaults(algorithm_class):
    """{CamelCase name: default} of the class itself."""
    algorithm = algorithm_class()
    names = option_names(algorithm_class).values()
    return {name: getattr(algorithm, "Get" + name)() for name in names}


def proxy_of(name):
    root = ElementTree.parse(ROOT / "Wrapping" / "ParaView" / "Footpoint" / f"{name}.xml").getroot()
    kinds = ("SourceProxy", "WriterProxy")
    proxies = [p for kind in kinds for p in root.findall(f".//{kind}[@name='{name}']")]
    assert len(proxies) == 1, f"{name}.xml has {len(proxies)} proxies of that name"
    return proxies[0]


def properties(proxy):
    """{name: element} of the options, inputs left out."""
    kinds = ("IntVectorProperty", "DoubleVectorProperty", "StringVectorProperty")
    return {p.get("name"): p for kind in kinds for p in proxy.findall(kind)}


def as_number(word, default):
    """A word of documentation as the type of a default."""
    known = {"on": True, "off": False, "True": True, "False": False, "all on": True}
    if isinstance(default, bool):
        return known[word]
    return ast.literal_eval(word)


class ParaView(unittest.TestCase):
    def test_defaults(self):
        for name, algorithm_class in CLASSES.items():
            elements = properties(proxy_of(name))
            expected = defaults(algorithm_class)
            self.assertEqual(set(elements), set(expected), name)
            for option, value in expected.items():
                words = elements[option].get("default_values")
                if value is None or isinstance(value, str):
                    self.assertEqual(words, value, option)
                    continue
                values = value if isinstance(value, tuple) else (value,)
                self.assertEqual([float(w) for w in words.split()], [float(v) for v in values],
                                 option)
                self.assertEqual(elements[option].get("number_of_elements"), str(len(values)))

    def test_commands_types_and_documentation(self):
        for name, algorithm_class in CLASSES.items():
            for option, element in properties(proxy_of(name)).items():
                self.assertEqual(element.get("command"), "Set" + option)
                self.assertGreater(len(element.findtext("Documentation").strip()), 20, option)
                value = defaults(algorithm_class)[option]
                boolean = element.find("BooleanDomain") is not None
                self.assertEqual(boolean, isinstance(value, bool), option)
                kind = {str: "String", type(None): "String", bool: "Int", int: "Int", float: "Double", tuple: "Double"}
                self.assertEqual(element.tag, kind[type(value)] + "VectorProperty", option)

    def test_enumerations(self):
        """Every value of the class, under its name."""
        for name, option in (("PointInversion", "Search"), ("PointInversion", "Method"),
                             ("SplineFileReader", "Format"), ("SplineFileWriter", "Format")):
            element = properties(proxy_of(name))[option]
            entries = element.findall("EnumerationDomain/Entry")
            algorithm = CLASSES[name]()
            for number, entry in enumerate(entries):
                self.assertEqual(entry.get("value"), str(number))
                getattr(algorithm, "Set" + option)(number)
                name = getattr(algorithm, f"Get{option}AsString")()
                self.assertEqual(entry.get("text"), name)
            getattr(algorithm, "Set" + option)(len(entries))
            self.assertEqual(getattr(algorithm, "Get" + option)(), len(entries) - 1, "no more")

    def test_ranges(self):
        """A slider's ends are the limits that the class clamps to."""
        for option, element in properties(proxy_of("PointInversion")).items():
            for domain in element.findall("*[@name='range']"):
                algorithm = footpoint.vtkPointInversionFilter()
                for end, beyond in (("min", -1), ("max", 1)):
                    if domain.get(end) is None:
                        continue
                    limit = type(defaults(type(algorithm))[option])(float(domain.get(end)))
                    getattr(algorithm, "Set" + option)(limit + beyond)
                    self.assertEqual(getattr(algorithm, "Get" + option)(), limit, option)

    def test_groups(self):
        """Each option is in one group; a group of advanced options is advanced."""
        for name in CLASSES:
            proxy = proxy_of(name)
            elements = properties(proxy)
            grouped = [p.get("name") for p in proxy.findall("PropertyGroup/Property")]
            self.assertEqual(sorted(grouped), sorted(elements))
            for group in proxy.findall("PropertyGroup"):
                for member in group.findall("Property"):
                    if group.get("panel_visibility") == "advanced":
                        visibility = elements[member.get("name")].get("panel_visibility")
                        self.assertEqual(visibility, "advanced", member.get("name"))
            files = proxy.find("Hints/ReaderFactory"), proxy.find("Hints/WriterFactory")
            if any(hint is not None for hint in files):  # comes by the dialogs of files
                continue
            self.assertEqual(proxy.find("Hints/ShowInMenu").get("category"), "Footpoint")


class Words(unittest.TestCase):
    def test_headers(self):
        """`Default: …` above each group of Set and Get."""
        for algorithm_class in CLASSES.values():
            name = algorithm_class.__name__
            header, = (path.read_text(encoding="utf-8") for folder in ("Filters", "IO")
                       for path in (ROOT / folder).glob(f"{name}.h"))
            for option, value in defaults(algorithm_class).items():
                before = re.split(rf"vtkSet\w*Macro\({option}\b", header)[0]
                self.assertLess(len(before), len(header), option)
                text = before[before.rindex("/**"):]
                found = re.search(r'Default: (\([^)]*\)|"[^"]*"|all on|[\w-]+(?:\.\d+)?)', text)
                self.assertIsNotNone(found, f"{option}: {text}")
                self.check(option, found.group(1), value, algorithm_class)

    def test_docstring_of_invert(self):
        doc = inspect.getdoc(footpoint.invert)
        stated = dict(re.findall(r"(?m)^(\w+(?:\.\.\.)?) : .*, default (.+)$", doc))
        switches = stated.pop("generate_...")
        names = option_names(footpoint.vtkPointInversionFilter)
        values = defaults(footpoint.vtkPointInversionFilter)
        for option, name in names.items():
            word = switches if option.startswith("generate_") else stated.pop(option)
            self.check(name, word, values[name], footpoint.vtkPointInversionFilter)
        self.assertEqual(stated, {}, "options that do not exist")

    def check(self, option, word, value, algorithm_class):
        algorithm = algorithm_class()
        if hasattr(algorithm, f"Get{option}AsString"):
            name = getattr(algorithm, f"Get{option}AsString")()
            self.assertEqual(word.lower(), name.lower(), option)
        elif value is None:
            self.assertEqual(word, "none", option)
        elif word.startswith("VTK_DOUBLE_MAX"):
            self.assertEqual(value, 1e299, option)
        else:
            self.assertEqual(as_number(word, value), value, option)


if __name__ == "__main__":
    unittest.main()
