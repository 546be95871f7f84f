# SPDX-License-Identifier: BSD-3-Clause
"""Splines as VTK's own Bézier cells, over vtkBezierExtraction."""

from ._options import set_options
from ._pipeline import connect, run
from .vtkFootpointFilters import vtkBezierExtraction


def bezier_cells(geometry, **options):
    """Exact spline geometry as Bézier cells, which VTK and ParaView draw by nonlinear subdivision.

    Parameters
    ----------
    geometry
        As in `invert`, except for a vtkParametricFunction, which is no spline.

    Options
    -------
    skip_trimmed_faces : bool, default False
        Leave out trimmed faces instead of taking their whole surfaces: cells cannot be trimmed.

    Returns
    -------
    vtkUnstructuredGrid
        Cells VTK_BEZIER_CURVE and VTK_BEZIER_QUADRILATERAL with the cell arrays `FaceId`,
        `ParameterRange` and `HigherOrderDegrees` (active), active `RationalWeights` where needed,
        and the field data `FaceName`, `Orientation` and `Tolerance`, a value for each face. It is
        geometry for `invert` in turn, with the same faces and parameters. vtkDataSetSurfaceFilter
        makes triangles of it, the finer the higher its NonlinearSubdivisionLevel.

    Raises
    ------
    ValueError
        All faces are bad; a bad face among others is left out with a RuntimeWarning. So are the
        trims of trimmed faces.
    TypeError
        `geometry` is of a type that is none of those; an unknown option.
    """
    extraction = vtkBezierExtraction()
    set_options(extraction, options, "bezier_cells")
    connect(geometry, extraction.SetInputConnection, extraction.SetInputDataObject)
    run(extraction)
    return extraction.GetOutput()
