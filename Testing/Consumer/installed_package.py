# SPDX-License-Identifier: BSD-3-Clause
"""Imports the installed package footpoint and makes sure that it is the installed one."""

import pathlib
import sys

import footpoint

prefix = pathlib.Path(sys.argv[1]).resolve()
found = pathlib.Path(footpoint.__file__).resolve()
if prefix not in found.parents:
    sys.exit(f"imported {found}, which is not below {prefix}")
footpoint.vtkPointInversionFilter()
footpoint.vtkSplineReader()
