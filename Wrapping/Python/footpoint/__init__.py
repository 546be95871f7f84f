# SPDX-License-Identifier: BSD-3-Clause
"""Exact spline geometry in VTK pipelines: point inversion on NURBS curves and surfaces."""

from .vtkFootpointFilters import *
