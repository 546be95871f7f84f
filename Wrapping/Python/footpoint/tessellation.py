# SPDX-License-Identifier: BSD-3-Clause
"""Spline geometry as triangles and polylines, over vtkSplineTessellator."""

from ._options import set_options
from ._pipeline import connect, run
from .vtkFootpointFilters import vtkSplineTessellator


def tessellate(geometry, **options):
    """Triangles of surfaces and polylines of curves, with exact normals, to a chord tolerance.

    Parameters
    ----------
    geometry
        A surface, a curve, a trimmed face, a composite data set or a list of them, or an algorithm
        that makes one.
    mode : str or int, default Adaptive
        Adaptive (as densely as the tolerances ask for) or Fixed (`resolution` segments for each knot
        span).
    chord_tolerance : float, default 0.001
        Largest distance between geometry and output, as a fraction of the size of the model. It is
        kept by bounds of second derivatives; only the slope of triangles, which counts in a small
        part of the bound, is measured, at their corners and with a margin.
    absolute_tolerance : bool, default False
        `chord_tolerance` is in model units.
    angle_tolerance : float, default 30.0
        Largest angle in degrees between the normals at two corners of a triangle; 0: any.
    resolution : int, default 4
        Segments for each knot span, where the mode is Fixed.
    flip_normals : bool, default False
        Reverse normals and triangles.

    Returns
    -------
    vtkPolyData
        Point arrays `Normals` (where there are surfaces) and `Parameters` (u, v), the active texture
        coordinates; cell array `FaceId`. Points are not shared between faces: vtkCleanPolyData with
        tolerance 0 makes a closed mesh of a closed solid.

    Raises
    ------
    ValueError
        The geometry is bad or an option is out of range. Faces that are left out are RuntimeWarnings.
    TypeError
        `geometry` is of a type that is none of those, or an option does not exist.
    """
    tessellator = vtkSplineTessellator()
    connect(geometry, tessellator.SetInputConnection, tessellator.SetInputDataObject)
    set_options(tessellator, options, "tessellate")
    run(tessellator)
    return tessellator.GetOutput()
