# SPDX-License-Identifier: BSD-3-Clause
"""What the XML of every proxy has for the user of ParaView's window: words for all that can be set,
groups, enumerations by name, a place in the menus, and conditions that name what exists.
"""

import re
import unittest

from proxies import FOLDER, for_each, options, proxies, text


def is_file(proxy):
    """A reader or writer, which comes by the dialogs of files."""
    hints = ("Hints/ReaderFactory", "Hints/WriterFactory")
    return any(proxy.find(hint) is not None for hint in hints)


def decorators(element):
    """The conditions of an option, those within composites too."""
    return element.findall("Hints//PropertyWidgetDecorator")


class Proxies(unittest.TestCase):
    @for_each(proxies)
    def test_names(self, name, proxy):
        built = (FOLDER / "CMakeLists.txt").read_text(encoding="utf-8")
        self.assertEqual(proxy.get("name"), name)
        self.assertIn(f"{name}.xml", built, "not part of the plugin")
        self.assertRegex(proxy.get("class"), r"^vtk\w+$")
        self.assertEqual(proxy.get("label").replace(" ", ""), name)

    @for_each(proxies)
    def test_documentation(self, _, proxy):
        documentation = proxy.find("Documentation")
        self.assertRegex(documentation.get("short_help"), r"^\S.{10,60}[^.\s]$")
        self.assertRegex(documentation.get("long_help"), r"^\S.{20,160}\.$")
        self.assertRegex(text(proxy), r"^[A-Z].{40,}\.$")

    @for_each(proxies)
    def test_every_property_is_explained(self, _, proxy):
        """These words are the tooltips."""
        inputs = {p.get("name"): p for p in proxy.findall("InputProperty")}
        for name, element in (inputs | options(proxy)).items():
            with self.subTest(property=name):
                words = text(element)
                self.assertRegex(words, r"^\S.{15,}\.$")
                spaced = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()
                self.assertNotEqual(words.rstrip(".").lower(), spaced, "says only its name")

    @for_each(proxies)
    def test_groups(self, _, proxy):
        """Each option is in one group; a group is advanced if and only if all its options are."""
        elements = options(proxy)
        groups = proxy.findall("PropertyGroup")
        grouped = [p.get("name") for group in groups for p in group.findall("Property")]
        self.assertEqual(sorted(grouped), sorted(elements))
        labels = [group.get("label") for group in groups]
        self.assertEqual(len(set(labels)), len(labels))
        for group in groups:
            with self.subTest(group=group.get("label")):
                self.assertTrue(group.get("label"))
                members = [elements[p.get("name")] for p in group.findall("Property")]
                advanced = [m.get("panel_visibility") == "advanced" for m in members]
                self.assertEqual(group.get("panel_visibility") == "advanced", all(advanced))

    @for_each(proxies)
    def test_menus(self, _, proxy):
        if is_file(proxy):
            for hint in ("ReaderFactory", "WriterFactory"):
                for factory in proxy.findall(f"Hints/{hint}"):
                    self.assertIn("Footpoint", factory.get("file_description"))
                    self.assertTrue(factory.get("extensions"))
        else:
            self.assertEqual(proxy.find("Hints/ShowInMenu").get("category"), "Footpoint")

    @for_each(proxies)
    def test_files_are_chosen_in_dialogs(self, _, proxy):
        self.assertEqual("FileName" in options(proxy), is_file(proxy))
        if is_file(proxy):
            name = options(proxy)["FileName"]
            self.assertEqual(name.get("panel_visibility"), "never")
            self.assertIsNotNone(name.find("FileListDomain"))

    @for_each(proxies)
    def test_conditions(self, _, proxy):
        """A condition is on another option of the proxy, and on values that this one can have."""
        elements = options(proxy)
        for name, element in elements.items():
            for decorator in decorators(element):
                with self.subTest(option=name):
                    self.check(decorator, name, elements)

    def test_conditions_are_found(self):
        """Or the test above would look at nothing."""
        found = sum(len(decorators(element)) for proxy in proxies().values()
                    for element in options(proxy).values())
        self.assertGreater(found, 20)

    def check(self, decorator, name, elements):
        if decorator.get("type") == "CompositeDecorator":
            self.assertIn(decorator.find("Expression").get("type"), ("and", "or"))
            return
        self.assertEqual(decorator.get("type"), "GenericDecorator")
        self.assertIn(decorator.get("mode"), ("visibility", "enabled_state"))
        self.assertNotEqual(decorator.get("property"), name)
        other = elements[decorator.get("property")]
        index = int(decorator.get("index", 0))
        self.assertLess(index, int(other.get("number_of_elements")))
        values = decorator.get("values", decorator.get("value")).split(" ")
        entries = [entry.get("value") for entry in other.findall("EnumerationDomain/Entry")]
        if other.find("BooleanDomain") is not None:
            entries = ["0", "1"]
        for value in values:
            if entries:
                self.assertIn(value, entries)
            else:
                self.assertEqual(value, f"{float(value):g}", "as ParaView writes the number")


if __name__ == "__main__":
    unittest.main()
