# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the gallery: grids between curves, coloured by the scaled Jacobian.

    gallery.py <output folder>

Writes six PNG files, which stand in Documentation/images/gallery, and prints their figures.
"""

import math
import pathlib
import sys

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderWindow

from inspection.drawing import add_text
from inspection.picture import SIZE, add_renderer, write_small_png


def columns(x, y, z=0.0):
    """Points (k, 3) of coordinates, which may be numbers."""
    return np.stack(np.broadcast_arrays(x, y, z), axis=-1).astype(float)


def figures(name, grid):
    """Prints and returns the number of folded cells and the smallest scaled Jacobian."""
    folded = int(vtk_to_numpy(grid.GetCellData().GetArray("Folded")).sum())
    worst = grid.GetCellData().GetArray("Jacobian").GetRange()[0]
    print(f"{name}: {grid.GetNumberOfCells()} cells, {folded} folded, "
          f"smallest scaled Jacobian {worst:.4f}")
    return folded, worst


def grid_points(grid):
    """(nv, nu, 3), u fastest."""
    nu, nv, _ = grid.GetDimensions()
    return vtk_to_numpy(grid.GetPoints().GetData()).reshape(nv, nu, 3)


def jacobian_colours():
    """Dark blue at 0, pale yellow at 1; folds are red."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(20)
    table.SetTableRange(0.0, 1.0)
    stops = np.array([[0.16, 0.18, 0.45], [0.13, 0.48, 0.60], [0.45, 0.76, 0.60],
                      [0.97, 0.96, 0.72]])
    for i in range(20):
        colour = [np.interp(i / 19.0, np.linspace(0, 1, 4), stops[:, k]) for k in range(3)]
        table.SetTableValue(i, *colour, 1.0)
    table.SetBelowRangeColor(0.85, 0.05, 0.05, 1.0)
    table.UseBelowRangeColorOn()
    return table


def add_grid(renderer, grid, colours):
    outside = vtkGeometryFilter()
    outside.SetInputData(grid)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(outside.GetOutputPort())
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("Jacobian")
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.EdgeVisibilityOn()
    look.SetEdgeColor(0.12, 0.14, 0.2)
    look.SetLineWidth(1.2)
    look.LightingOff()
    renderer.AddActor(actor)


def add_legend(page, colours):
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("  %.2f")
    bar.UnconstrainedFontSizeOn()
    bar.SetPosition(0.90, 0.16)
    bar.SetWidth(0.06)
    bar.SetHeight(0.60)
    style = bar.GetLabelTextProperty()
    style.SetFontSize(24)
    style.SetColor(0.13, 0.15, 0.18)
    style.ItalicOff()
    style.BoldOff()
    style.ShadowOff()
    page.AddActor2D(bar)
    add_text(page, "Scaled", 1590, 760, size=26, bold=True, justify="Right")
    add_text(page, "Jacobian", 1590, 728, size=26, bold=True, justify="Right")
    add_text(page, "red: folded", 1590, 90, size=24, colour=(0.85, 0.05, 0.05), justify="Right")


def make_picture(path, title, panels):
    """panels: (label, list of grids, direction to the eye, up, box or None)."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    page = add_renderer(window, (0, 0, *SIZE))
    colours = jacobian_colours()
    width = 1400 // len(panels)
    for i, (label, grids, eye, up, box) in enumerate(panels):
        view = add_renderer(window, (20 + i * width, 70, 10 + (i + 1) * width, 810))
        for grid in grids:
            add_grid(view, grid, colours)
        camera = view.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(0, 0, 0)
        camera.SetPosition(*eye)
        camera.SetViewUp(*up)
        if box:  # centre and height
            camera.SetFocalPoint(*box[0])
            camera.SetPosition(*(np.add(box[0], eye)))
            camera.SetParallelScale(0.5 * box[1])
            view.ResetCameraClippingRange()
        else:
            view.ResetCameraScreenSpace()
            camera.Zoom(0.97)
        add_text(page, label, 20 + (i + 0.5) * width, 28, size=28, justify="Centered")
    add_text(page, title, 30, 842, size=36, bold=True)
    add_legend(page, colours)
    window.Render()
    for width in (1000, 900, 800, 700):  # the dense grid of the airfoil compresses badly
        write_small_png(window, path, width, 96)
        if path.stat().st_size < 120000:
            break


FLAT = ((0, 0, 1), (0, 1, 0))


def airfoil():
    """A C-grid about NACA 0012: wake, airfoil and wake again face a C."""
    beta = np.linspace(0, np.pi, 37)
    x = 0.5 * (1 - np.cos(beta))  # from the nose to the sharp trailing edge
    y = 0.6 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    y[-1] = 0.0
    wake = 1 + 2 * (np.expm1(4 * np.linspace(0, 1, 21)) / np.expm1(4))
    lower = np.r_[columns(wake[::-1], 0), columns(x, -y)[::-1][1:]]
    wall = np.r_[lower, (lower * [1, -1, 1])[::-1][1:]]
    turn = np.linspace(0, np.pi / 2, 37)  # the far C: two lines and a half circle
    low = np.r_[columns(wake[::-1], -2),
                columns(1 - 2 * np.sin(turn), -2 * np.cos(turn))[1:]]
    far = np.r_[low, (low * [1, -1, 1])[::-1][1:]]
    t = np.expm1(5 * np.linspace(0, 1, 29)) / np.expm1(5)
    ends = [columns(3, sign * 2 * t) for sign in (-1, 1)]
    grid = footpoint.coons_patch(
        wall, ends[1], far, ends[0], strict=True, resolution=(0, 0),
        parametrization="ArcLengthBlended")
    folded, _ = figures("airfoil", grid)
    assert folded == 0
    points = grid_points(grid)
    step = np.linalg.norm(points[1] - points[0], axis=1)
    print(f"airfoil: first cells between {step.min():.4f} and {step.max():.4f} chords high")
    return "NACA 0012: a C-grid by arc-length-blended Coons interpolation", [
        ("whole grid", [grid], *FLAT, ((1, 0, 0), 4.4)),
        ("at the airfoil", [grid], *FLAT, ((0.5, 0, 0), 1.15))]


def swan():
    """Before and after smoothing."""
    s = np.linspace(0, 1, 101)
    sides = (columns(s, 0), columns(1 + 2 * s - 2 * s**2, s),
             columns(s, 1 - 3 * s + 3 * s**2), columns(0, s))
    plain = footpoint.coons_patch(*sides)
    mended = footpoint.coons_patch(*sides, smoothing="Auto")
    before, _ = figures("swan, plain", plain)
    after, _ = figures("swan, Smoothing=Auto", mended)
    assert (before, after) == (18, 0)
    return "Swan: folds before and after Smoothing=Auto", [
        (f"plain: {before} folded cells", [plain], *FLAT, None),
        ("the folds", [plain], *FLAT, ((0.27, 0.5, 0), 0.55)),
        (f"Auto: {after} folded cells", [mended], *FLAT, None)]


def horseshoe():
    """Between two halves of ellipses; semi-axes 1 and 4.5, 2 and 9."""
    s = np.linspace(0, 1, 401)
    angle = np.pi * s
    inner, outer = (columns(-a * np.cos(angle), 4.5 * a * np.sin(angle)) for a in (1, 2))
    sides = (inner, columns(1 + s, 0), outer, columns(-1 - s, 0))
    panels = []
    for label, smoothing, known in (("plain", "None", 0.3952), ("Winslow", "Winslow", 0.2324)):
        grid = footpoint.coons_patch(*sides, smoothing=smoothing)
        folded, worst = figures(f"horseshoe, {label}", grid)
        assert folded == 0 and abs(worst - known) < 1e-4
        panels.append((f"{label}: smallest {worst:.3f}", [grid], *FLAT, None))
    return "Horseshoe: plain interpolation and Winslow smoothing", panels


def hull():
    """Wigley's hull from the edges of its two halves; length 10, beam 2, draught 1.25."""
    length, beam, draught = 10.0, 2.0, 1.25

    def breadth(x, z):
        return 0.5 * beam * (1 - (2 * x / length) ** 2) * (1 - (z / draught) ** 2)

    grids, deviation = [], 0.0
    z = np.linspace(-draught, 0, 41)
    for end in (-0.5 * length, 0.5 * length):
        x = np.linspace(0, end, 81)
        for side in (1, -1):
            grid = footpoint.coons_patch(
                columns(x, 0, -draught), columns(end, 0, z), columns(x, side * breadth(x, 0)),
                columns(0, side * breadth(0, z), z), resolution=(25, 13))
            folded, _ = figures("hull, one of four", grid)
            assert folded == 0
            points = grid_points(grid)
            exact = breadth(points[..., 0], points[..., 2])
            deviation = max(deviation, np.abs(np.abs(points[..., 1]) - exact).max())
            grids.append(grid)
    print(f"hull: at most {deviation:.4f} from Wigley's hull")
    assert np.isclose(deviation, beam / 32)  # edges alone say no more: (1/4)² of half the beam
    return "Wigley hull: four Coons patches from keel, waterline, posts and midship section", [
        ("ahead, below", grids, (8, -5, -6), (0, 0, 1), None),
        ("ahead, above", grids, (8, -5, 6), (0, 0, 1), None)]


def bezier(control, t):
    """Points of a Bézier curve by its closed form."""
    n = len(control) - 1
    basis = [math.comb(n, i) * t**i * (1 - t) ** (n - i) for i in range(n + 1)]
    return np.tensordot(np.array(basis), np.asarray(control, float), axes=(0, 0))


def nacelle():
    """A half body through profiles and guides, and its mirror image."""
    k = 4 * (np.sqrt(2) - 1) / 3  # cubics near a half circle, from the top down to the keel line
    circle = np.array([(0, 1), (k, 1), (1, k), (1, 0), (1, -k), (k, -1), (0, -1)])
    flat = np.array([(0, 0), (0, 0), (0, 0), (0, 0), (0.05, 0), (0.1, 1), (0, 1)])  # below
    meridian = np.array([(0.7, 0.72), (-0.55, 0.68), (-0.2, 1.1), (1.3, 1.25), (2.8, 1.1),
                         (4, 0.6)])  # x and radius
    flatness = np.array([0, 0.1, 0.25, 0.25, 0.1, 0])
    cubic = [0] * 4 + [0.5] * 3 + [1] * 4

    def section(v):
        x, r = bezier(meridian, v)
        yz = r * circle + bezier(flatness, v) * flat
        return columns(x, yz[:, 0], yz[:, 1])

    def across(points, u):
        return bezier(points[:4], 2 * u) if u <= 0.5 else bezier(points[3:], 2 * u - 1)

    profiles = [footpoint.nurbs_curve(section(v), cubic) for v in np.linspace(0, 1, 7)]
    guides = []
    for u in (0, 0.25, 0.5, 0.75, 1):
        round_, low = across(circle, u), across(flat, u)
        yz = meridian[:, 1:] * round_ + flatness[:, None] * low
        guides.append(footpoint.nurbs_curve(
            columns(meridian[:, 0], yz[:, 0], yz[:, 1]), [0] * 6 + [1] * 6))
    surface = footpoint.gordon_surface(profiles, guides)
    t = np.linspace(0, 1, 101)
    on_curves = np.concatenate([footpoint.evaluate(curve, t) for curve in profiles + guides])
    gap = footpoint.invert(on_curves, surface).distance.max()
    print(f"nacelle: curves at most {gap:.1e} from the Gordon surface")
    assert gap < 1e-9
    u, v = np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 41), indexing="ij")
    points = footpoint.evaluate(surface, np.c_[u.ravel(), v.ravel()]).reshape(41, 41, 3)
    grids = []
    for mirror in (1, -1):
        grids.append(footpoint.smooth_grid(points * [1, mirror, 1], method="None"))
        assert figures("nacelle, half", grids[-1])[0] == 0
    return "Nacelle: a Gordon surface through 7 profiles and 5 guides", [
        ("one half and its mirror image", grids, (-6, -7, 3), (0, 0, 1), None)]


def passage():
    """The volume between two cambered, twisted blades of an annulus."""
    u, v, w = (np.linspace(0, 1, n) for n in (49, 17, 17))

    def place(u, v, w):
        """Closed form; exact on the six faces alone is what is used."""
        x = -0.5 + 2 * u
        c = np.clip(x, 0, 1)
        camber = (0.55 + 0.25 * w) * (x * (1.4 - 0.4 * x))
        half = 0.5 * 0.5 * (c * (1 - c)) ** 1.5
        pitch = 0.75
        y = camber + half + v * (pitch - 2 * half)
        radius = 2 + 1.1 * w
        return columns(x, radius * np.sin(y / 2.5), radius * np.cos(y / 2.5))

    def face(a, b, function):
        return function(*np.meshgrid(a, b, indexing="ij"))

    faces = [face(v, w, lambda a, b, e=e: place(e, a, b)) for e in (0.0, 1.0)]
    faces += [face(u, w, lambda a, b, e=e: place(a, e, b)) for e in (0.0, 1.0)]
    faces += [face(u, v, lambda a, b, e=e: place(a, b, e)) for e in (0.0, 1.0)]
    volume = footpoint.transfinite_volume(faces)
    folded, _ = figures("passage", volume)
    assert folded == 0 and volume.GetNumberOfCells() == 48 * 16 * 16
    return "Blade passage: a volume between six faces", [
        ("pressure side and casing", [volume], (-2, 6, 5), (0, 0, 1), None),
        ("suction side and hub", [volume], (-2, -6, -2), (0, 0, 1), None)]


def main(folder):
    for shape in (airfoil, swan, horseshoe, hull, nacelle, passage):
        make_picture(folder / f"{shape.__name__}.png", *shape())


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
