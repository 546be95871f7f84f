# SPDX-License-Identifier: BSD-3-Clause
"""One default everywhere: what the classes return, ParaView's XML, the headers' and Python's words.
Every class that has a proxy is looked at, and every option of it.
"""

import ast
import inspect
from pathlib import Path
import re
import unittest

import footpoint
from footpoint._options import option_names
from proxies import classes, for_each, options, proxies

ROOT = Path(__file__).resolve().parents[2]


def defaults(algorithm_class):
    """{CamelCase name: default} of the class itself."""
    algorithm = algorithm_class()
    names = option_names(algorithm_class).values()
    return {name: getattr(algorithm, "Get" + name)() for name in names}


def properties(name):
    """{name: element} of the options of a proxy."""
    return options(proxies()[name])


def as_number(word, default):
    """A word of documentation as the type of a default."""
    known = {"on": True, "off": False, "True": True, "False": False, "all on": True}
    if isinstance(default, bool):
        return known[word]
    return ast.literal_eval(word.replace("\N{MINUS SIGN}", "-"))


class ParaView(unittest.TestCase):
    def test_every_class_is_found(self):
        """None is left out in silence: a wrapped algorithm of ours has a proxy."""
        ours = [value for name, value in vars(footpoint).items()
                if name.startswith("vtk") and hasattr(value, "SetInputConnection")]
        self.assertEqual({c.__name__ for c in classes().values()}, {c.__name__ for c in ours})

    @for_each(classes)
    def test_defaults(self, name, algorithm_class):
        elements = properties(name)
        expected = defaults(algorithm_class)
        self.assertEqual(set(elements), set(expected))
        for option, value in expected.items():
            words = elements[option].get("default_values")
            if value is None or isinstance(value, str):
                self.assertEqual(words, value, option)
                continue
            values = value if isinstance(value, tuple) else (value,)
            self.assertEqual([float(w) for w in words.split()], [float(v) for v in values], option)
            self.assertEqual(elements[option].get("number_of_elements"), str(len(values)))

    @for_each(classes)
    def test_commands_and_types(self, name, algorithm_class):
        kinds = {str: "String", type(None): "String", bool: "Int", int: "Int", float: "Double"}
        for option, element in properties(name).items():
            self.assertEqual(element.get("command"), "Set" + option)
            value = defaults(algorithm_class)[option]
            boolean = element.find("BooleanDomain") is not None
            self.assertEqual(boolean, isinstance(value, bool), option)
            kind = kinds[type(value[0] if isinstance(value, tuple) else value)]
            self.assertEqual(element.tag, kind + "VectorProperty", option)

    @for_each(classes)
    def test_enumerations(self, name, algorithm_class):
        """Every value of the class, under its name, and no number where there are names."""
        algorithm = algorithm_class()
        for option, element in properties(name).items():
            entries = element.findall("EnumerationDomain/Entry")
            named = hasattr(algorithm, f"Get{option}AsString")
            self.assertEqual(bool(entries), named, option)
            for number, entry in enumerate(entries):
                self.assertEqual(entry.get("value"), str(number))
                getattr(algorithm, "Set" + option)(number)
                value = getattr(algorithm, f"Get{option}AsString")()
                self.assertEqual(entry.get("text"), value)
            if entries:
                getattr(algorithm, "Set" + option)(len(entries))
                self.assertEqual(
                    getattr(algorithm, "Get" + option)(), len(entries) - 1, "no more")

    @for_each(classes)
    def test_ranges(self, name, algorithm_class):
        """A slider's ends are the limits that the class clamps to, where it clamps."""
        for option, element in properties(name).items():
            default = defaults(algorithm_class)[option]
            if isinstance(default, tuple):
                continue  # no class clamps vectors
            for domain in element.findall("*[@name='range']"):
                algorithm = algorithm_class()
                for end, beyond in (("min", -1), ("max", 1)):
                    if domain.get(end) is None:
                        continue
                    limit = type(default)(float(domain.get(end)))
                    getattr(algorithm, "Set" + option)(limit + beyond)
                    self.assertEqual(getattr(algorithm, "Get" + option)(), limit, option)


class Words(unittest.TestCase):
    @for_each(classes)
    def test_headers(self, _, algorithm_class):
        """`Default: …` above each group of Set and Get."""
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
            self.assertEqual(word.replace("_", "").lower(), name.lower(), option)
        elif value is None:
            self.assertEqual(word, "none", option)
        elif word.startswith("VTK_DOUBLE_MAX"):
            self.assertEqual(value, 1e299, option)
        else:
            self.assertEqual(as_number(word, value), value, option)


if __name__ == "__main__":
    unittest.main()
