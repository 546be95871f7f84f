# SPDX-License-Identifier: BSD-3-Clause
"""Shapes as exact NURBS, over vtkNURBSShapeSource."""

from ._options import set_options
from ._pipeline import run
from .vtkFootpointFilters import vtkNURBSShapeSource


def nurbs_shape(shape, **options):
    """A shape as exact NURBS, to start from without a file; its normals point outwards.

    Parameters
    ----------
    shape : str or int
        "sphere", "cylinder", "cone", "torus", "wing" (sections of the NACA 4-digit series), "ship_hull"
        (Wigley's), "teapot" (Newell's), "bumpy" (random), "circle" or "helix"; or its number in
        vtkNURBSShapeSource. All are exact up to rounding but the helix, which no NURBS curve is.

    Options
    -------
    An option of another shape changes nothing.

    center : 3 floats, default (0, 0, 0)
        Where the shape's origin stands.
    radius : float, default 1.0
        Of sphere, cylinder, cone, torus, circle and helix.
    cross_section_radius : float, default 0.3
        Of the torus' tube, less than radius.
    height : float, default 2.0
        Of cylinder, cone and helix.
    capping : bool, default False
        Close cylinder, cone, wing and hull by further faces.
    airfoil_digits : str, default "2412"
        The wing's section: camber in % of the chord, its place in 10 %, thickness in %.
    chord, span : float, default 1.0 and 6.0
        Of the wing: chord in its middle, span from tip to tip.
    taper_ratio : float, default 0.5
        The wing's chord at its tips as a fraction of chord.
    sweep_angle : float, default 15.0
        Of the wing's leading edge, degrees.
    blunt_trailing_edge : bool, default False
        Leave the wing's trailing edge as thick as NACA published it.
    length, beam, draft : float, default 10.0, 1.0 and 0.625
        Of the hull.
    size, amplitude : float, default 2.0 and 0.25
        Edge of the bumpy patch, and largest height of its control points.
    resolution, seed : int, default 8 and 1
        Knot spans of the bumpy patch in each direction; which one it is.
    turns : float, default 3.0
        Of the helix.
    helix_tolerance : float, default 1e-06
        How far it may be from a true one, as a fraction of radius.

    Returns
    -------
    vtkStructuredGrid or vtkMultiBlockDataSet
        The control net of a surface or curve, as `nurbs_surface` and `nurbs_curve` make them; of the
        teapot, the hull and with capping a model with a block for each face.

    Raises
    ------
    ValueError
        There is no such shape, or none of these dimensions; the text names the option and its value.
    TypeError
        An unknown option, or an option's value of the wrong type.
    """
    source = vtkNURBSShapeSource()
    set_options(source, {"shape": shape, **options}, "nurbs_shape")
    run(source)
    return source.GetOutputDataObject(0)
