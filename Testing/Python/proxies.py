# SPDX-License-Identifier: BSD-3-Clause
"""The plugin's XML files, for the tests that look at every one of them: a new file needs no list."""

import functools
from pathlib import Path
import xml.etree.ElementTree as ElementTree

import footpoint

FOLDER = Path(__file__).resolve().parents[2] / "Wrapping" / "ParaView" / "Footpoint"
OPTIONAL = {"vtkCADReader"}  # not without Open CASCADE


def proxies():
    """{name of the file: element of its one proxy}."""
    result = {}
    for path in sorted(FOLDER.glob("*.xml")):
        root = ElementTree.parse(path).getroot()
        found = [p for kind in ("SourceProxy", "WriterProxy") for p in root.findall(f".//{kind}")]
        assert len(found) == 1, f"{path.name} has {len(found)} proxies"
        result[path.stem] = found[0]
    assert len(result) >= 10, f"{len(result)} files in {FOLDER}"
    return result


def classes():
    """{name of the proxy: wrapped class}, those left out that this build is without."""
    result = {}
    for name, proxy in proxies().items():
        if hasattr(footpoint, proxy.get("class")) or proxy.get("class") not in OPTIONAL:
            result[name] = getattr(footpoint, proxy.get("class"))
    return result


def options(proxy):
    """{name: element} of a proxy's properties, inputs left out."""
    kinds = ("IntVectorProperty", "DoubleVectorProperty", "StringVectorProperty")
    return {p.get("name"): p for kind in kinds for p in proxy.findall(kind)}


def text(element):
    """The words of an element's Documentation, on one line."""
    return " ".join((element.findtext("Documentation") or "").split())


def for_each(things):
    """Makes a test of `check(self, name, thing)`: one subtest for every item of things()."""

    def decorate(check):
        @functools.wraps(check)
        def test(self):
            for name, thing in things().items():
                with self.subTest(proxy=name):
                    check(self, name, thing)

        return test

    return decorate
