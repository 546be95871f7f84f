# SPDX-License-Identifier: BSD-3-Clause
"""Options appear in ParaView's panel where they act, and only there: every option with a condition,
under every setting of those that it depends on. Documentation/examples/window/start.py runs this.
"""

import itertools
from pathlib import Path
import sys
import unittest

from paraview import simple

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "Testing" / "Python"))

from proxies import options, proxies  # noqa: E402
import window  # noqa: E402

ALONG_Z, NONE = [0, 0, 1], [0, 0, 0]
SEARCHES = ["Seeded", "Local", "Global"]
SMOOTHINGS = ["Auto", "Laplacian", "Winslow", "None"]
#: Of each shape the options that act. The default is last, so that every step is a change.
SHAPES = {
    "Cylinder": {"Radius", "Height", "Capping"},
    "Cone": {"Radius", "Height", "Capping"},
    "Torus": {"Radius", "CrossSectionRadius"},
    "Wing": {"AirfoilDigits", "Chord", "Span", "TaperRatio", "SweepAngle", "BluntTrailingEdge",
             "Capping"},
    "ShipHull": {"Length", "Beam", "Draft", "Capping"},
    "Teapot": set(),
    "Bumpy": {"Size", "Amplitude", "Resolution", "Seed"},
    "Circle": {"Radius"},
    "Helix": {"Radius", "Height", "Turns", "HelixTolerance"},
    "Sphere": {"Radius"},
}


def uses_method(s):
    return s["Search"] != "Global" or s["AllFeet"] or s["OrthogonalOnly"] or \
        s["FixedDirection"] != NONE


#: Of each proxy: what its conditions depend on, with the values to try, and when an option is shown.
SHOWN = {
    "PointInversion": ({
        "Search": SEARCHES, "AllFeet": [True, False], "OrthogonalOnly": [True, False],
        "FixedDirection": [ALONG_Z, NONE]
    }, {
        "CertificateTolerance": lambda s: s["Search"] == "Global",
        "Method": uses_method,
        "WarmStart": lambda s: s["Search"] != "Global",
        "SeedResolution": lambda s: s["Search"] != "Global",
        "NumberOfSeeds": lambda s: s["Search"] == "Seeded",
    }),
    "CoonsPatch": ({
        "Smoothing": SMOOTHINGS, "CellType": ["Triangles", "Quads"],
        "ForceCornerMatch": [True, False], "CornerIds": [[0, 1, 2, 3], [-1, -1, -1, -1]]
    }, {
        "MaximumSmoothingIterations": lambda s: s["Smoothing"] != "None",
        "TriangleStyle": lambda s: s["CellType"] == "Triangles",
        "CornerTolerance": lambda s: s["ForceCornerMatch"],
        "CornerAngle": lambda s: s["CornerIds"][0] == -1,
    }),
    "GordonSurface": ({
        "Reparametrize": [True, False]
    }, {
        "ReparametrizationTolerance": lambda s: s["Reparametrize"],
    }),
    "StructuredGridSmoother": ({
        "Method": SMOOTHINGS
    }, {
        "MaximumIterations": lambda s: s["Method"] != "None",
        "Tolerance": lambda s: s["Method"] != "None",
        "Boundary": lambda s: s["Method"] != "None",
        "ControlFunctions": lambda s: s["Method"] in ("Auto", "Winslow"),
    }),
    "SplineTessellator": ({
        "Mode": ["Fixed", "Adaptive"]
    }, {
        "ChordTolerance": lambda s: s["Mode"] == "Adaptive",
        "AbsoluteTolerance": lambda s: s["Mode"] == "Adaptive",
        "AngleTolerance": lambda s: s["Mode"] == "Adaptive",
        "Resolution": lambda s: s["Mode"] == "Fixed",
    }),
    "NURBSShapeSource": ({
        "Shape": list(SHAPES)
    }, {
        option: lambda s, option=option: option in SHAPES[s["Shape"]]
        for option in sorted(set().union(*SHAPES.values()))
    }),
    "CADReader": ({
        "GenerateMesh": [False, True]
    }, {
        "Deflection": lambda s: s["GenerateMesh"],
        "AngularDeflection": lambda s: s["GenerateMesh"],
    }),
}

#: The same for options that are there but cannot be changed.
ENABLED = {
    "PointInversion": {
        "FixedDirection": lambda s: not (s["AllFeet"] or s["OrthogonalOnly"]),
    },
}


def conditional_options(proxy):
    return {name: element for name, element in options(proxy).items()
            if element.find("Hints//PropertyWidgetDecorator") is not None}


def rules_of_xml(proxy):
    """The same as an entry of SHOWN, of a proxy that is not there: what its XML says."""
    settings, wanted = {}, {}
    for name, element in conditional_options(proxy).items():
        for decorator in element.findall("Hints/PropertyWidgetDecorator"):
            assert decorator.get("type") == "GenericDecorator" and \
                decorator.get("mode") == "visibility", f"{name}: put its proxy into the table"
            other = decorator.get("property")
            entries = options(proxy)[other].findall("EnumerationDomain/Entry")
            values = {entry.get("value"): entry.get("text") for entry in entries} or \
                {"0": False, "1": True}
            settings[other] = list(values.values())[::-1]
            listed = (decorator.get("values") or decorator.get("value")).split()
            inverse = decorator.get("inverse") == "1"
            wanted.setdefault(name, []).append(
                (other, [v for k, v in values.items() if (k in listed) != inverse]))
    return settings, {
        name: lambda s, conditions=conditions: all(s[o] in good for o, good in conditions)
        for name, conditions in wanted.items()}


class Conditions(unittest.TestCase):
    def test_table_is_complete(self):
        """An option with a condition is in the tables, if its proxy is."""
        for name in SHOWN:
            if name in proxies():
                listed = set(SHOWN[name][1]) | set(ENABLED.get(name, {}))
                self.assertEqual(set(conditional_options(proxies()[name])), listed, name)

    def test_options_are_shown_where_they_act(self):
        panel = window.Panel()
        for name, xml in proxies().items():
            settings, shown = SHOWN[name] if name in SHOWN else rules_of_xml(xml)
            if not settings:
                continue
            if not hasattr(simple, name):
                self.assertEqual(name, "CADReader")  # not without Open CASCADE
                continue
            simple.ResetSession()
            proxy = getattr(simple, name)()
            simple.SetActiveSource(proxy)
            window.wait(lambda: panel.has(next(iter(settings))), f"the panel of {name}")
            panel.show_advanced()
            with self.subTest(proxy=name):
                self.try_all(panel, settings, shown, ENABLED.get(name, {}))

    def try_all(self, panel, settings, shown, enabled):
        state, seen = {}, {option: set() for option in shown}
        for values in itertools.product(*settings.values()):
            for option, value in zip(settings, values):
                if state.get(option) != value and panel.option(option).isEnabled():
                    panel.set(option, value)
                    state[option] = value
            with self.subTest(**state):
                for option, condition in shown.items():
                    visible = panel.option(option).isVisible()
                    self.assertEqual(visible, bool(condition(state)), option)
                    seen[option].add(visible)
                for option, condition in enabled.items():
                    self.assertEqual(
                        panel.option(option).isEnabled(), bool(condition(state)), option)
        for option, states in seen.items():
            self.assertEqual(states, {True, False}, f"{option} is never changed")


if __name__ == "__main__":
    window.main_window().resize(1400, 1000)
    unittest.main()
