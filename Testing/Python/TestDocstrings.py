# SPDX-License-Identifier: BSD-3-Clause
"""The help: every public function and class explains itself, its example runs, options are listed."""

import contextlib
import doctest
import inspect
import io
import pydoc
import unittest

import footpoint
from footpoint._options import option_names

FUNCTIONS = ("nurbs_surface", "nurbs_curve", "trimmed_face", "model", "invert", "evaluate",
             "read_splines", "write_splines", "tessellate")
CLASSES = ("vtkPointInversionFilter", "vtkSplineEvaluator", "vtkSplineReader", "vtkSplineWriter",
           "vtkSplineTessellator",
           "InversionResult", "Feet", "Status",
           "FootType")


class Docstrings(unittest.TestCase):
    def test_functions(self):
        for name in FUNCTIONS:
            function = getattr(footpoint, name)
            doc = inspect.getdoc(function)
            for part in ("Parameters\n---", "Returns\n---", "Raises\n---"):
                self.assertIn(part, doc, name)
            for parameter in inspect.signature(function).parameters:
                if parameter != "options":
                    self.assertRegex(doc, rf"(?m)^(.*, )?{parameter}\b", f"{name}({parameter})")
            first = doc.splitlines()[0]
            self.assertTrue(first.endswith(".") and len(first) <= 100, first)

    def test_classes_and_module(self):
        for name in CLASSES:
            self.assertGreater(len(inspect.getdoc(getattr(footpoint, name)) or ""), 40, name)
            self.assertIn(name, footpoint.__doc__ + repr(CLASSES))
        for name in FUNCTIONS:
            self.assertIn(name, footpoint.__doc__)

    def test_signatures(self):
        for function, signature in (
            (footpoint.nurbs_surface, "(control_points, knots_u, knots_v, weights=None)"),
            (footpoint.nurbs_curve, "(control_points, knots, weights=None)"),
            (footpoint.trimmed_face, "(net, loops)"),
            (footpoint.read_splines, "(path, format='Auto')"),
            (footpoint.write_splines, "(geometry, path, format='Auto')"),
            (footpoint.evaluate, "(geometry, parameters, faces=None)"),
            (footpoint.tessellate, "(geometry, **options)"),
            (footpoint.invert,
             "(points, geometry, *, seed_parameters=None, seed_face_id=None, **options)"),
        ):
            self.assertEqual(str(inspect.signature(function)), signature)

    def test_help_is_readable(self):
        for name in FUNCTIONS:
            text = pydoc.plain(pydoc.render_doc(getattr(footpoint, name)))
            for line in text.splitlines():
                self.assertLessEqual(len(line), 105, f"{name}: {line}")

    def test_every_option_is_described(self):
        doc = inspect.getdoc(footpoint.invert)
        for option in option_names(footpoint.vtkPointInversionFilter):
            self.assertRegex(doc, rf"\b{option}\b", option)

    def test_example(self):
        report = io.StringIO()
        with contextlib.redirect_stdout(report):  # pvpython's own stream has no encoding
            result = doctest.testmod(footpoint)
        self.assertGreater(result.attempted, 2)
        self.assertEqual(result.failed, 0, report.getvalue())

    def test_wrapped_classes_are_documented(self):
        for name in option_names(footpoint.vtkPointInversionFilter).values():
            method = getattr(footpoint.vtkPointInversionFilter, "Get" + name)
            self.assertTrue(method.__doc__, name)


if __name__ == "__main__":
    unittest.main()
