# SPDX-License-Identifier: BSD-3-Clause
"""Exact spline geometry in VTK pipelines: point inversion on NURBS curves and surfaces.

Point inversion finds, for a point P, the nearest point Q of a geometry (the foot point) and its
parameters. Nothing is tessellated: distances and parameters are those of the exact geometry.

In NumPy terms
--------------
    nurbs_surface, nurbs_curve   control points, knots and weights -> geometry
    nurbs_shape                  sphere, torus, wing, hull, teapot, ... by name -> geometry
    trimmed_face, model          geometry from parts: surface and trim loops, several faces
    invert                       points -> feet, parameters, distances, statistics
    evaluate                     parameters -> points, the inverse
    bezier_cells                 geometry -> cells that VTK draws, which are geometry in turn
    tessellate                   geometry -> triangles and polylines to a chord tolerance
    coons_patch                  four boundary polylines -> structured grid
    coons_surface                four NURBS curves -> the Coons surface as a NURBS surface
    gordon_surface               network of NURBS curves -> NURBS surface through it
    transfinite_volume           six faces or twelve edges -> structured grid of a volume
    smooth_grid                  structured grid -> the same without folds
    read_splines, write_splines  files of G+Smo (.xml), GoTools (.g2) and geomdl (.json)
    read_cad, read_cad_parts     STEP, IGES or BREP file -> exact faces; also mesh and edges
    Status, FootType             names of the numbers that `invert` returns

In a VTK pipeline
-----------------
    vtkPointInversionFilter, vtkSplineEvaluator, vtkBezierExtraction, vtkNURBSShapeSource,
    vtkCoonsPatchSource, vtkCoonsSurface, vtkGordonSurface, vtkTransfiniteVolume,
    vtkStructuredGridSmoother, vtkSplineTessellator
        the classes behind those functions
    vtkSplineReader, vtkSplineWriter, vtkCADReader
        files of splines; STEP, IGES and BREP files (where Open CASCADE is built in)

Example
-------
>>> import numpy as np, footpoint
>>> patch = footpoint.nurbs_surface(            # z = x y on the unit square
...     [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]],
...     knots_u=[0, 0, 1, 1], knots_v=[0, 0, 1, 1])
>>> r = footpoint.invert([[0.5, 0.5, 0.25], [0.2, 0.3, 2.0]], patch)
>>> r.parameters[0]
array([0.5, 0.5])
>>> np.allclose(footpoint.evaluate(patch, r.parameters), r.closest_points)
True

Geometry is plain VTK data (a vtkStructuredGrid of control points with the field data KnotsU and
KnotsV), so VTK's readers and writers serve for it. Errors of the filters are ValueErrors that name
the array, the index and the value.
"""

from .vtkFootpointFilters import *
from .vtkFootpointIO import *
from .geometry import model, nurbs_curve, nurbs_surface, trimmed_face
from .inversion import Feet, FootType, InversionResult, Status, invert
from .bezier import bezier_cells
from .cad import CADParts, read_cad, read_cad_parts
from .evaluation import evaluate
from .files import read_splines, write_splines
from .grids import (
    coons_patch,
    coons_surface,
    gordon_surface,
    smooth_grid,
    transfinite_volume,
)
from .shapes import nurbs_shape
from .tessellation import tessellate
from ._version import __version__
