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

if hasattr(footpoint, "vtkCADReader"):
    # Its answer, not that it could not be started, comes from the program beside the library.
    try:
        footpoint.read_cad(__file__)
        sys.exit("a Python program was read as a CAD file")
    except ValueError as error:
        if "it is neither STEP" not in str(error):
            raise
