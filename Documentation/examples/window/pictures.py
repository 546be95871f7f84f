# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of ParaView's window in the guide, made by doing what the guide says.

    FOOTPOINT_PLUGIN=<path of Footpoint.so> python3 start.py pictures.py <output folder>
"""

from pathlib import Path
import sys

from paraview import simple
from PyQt5.QtCore import QPoint, QRect, QSize, Qt
from PyQt5.QtGui import QColor, QImage
from PyQt5.QtWidgets import QApplication, QDockWidget

import window

PART = Path("/usr/share/opencascade/data/step/linkrods.step")  # of Debian's Open CASCADE
FOLDER = Path(sys.argv[1])
SCAN = FOLDER / "rod_scan.vtp"
#: A link rod, in mm, that came out bent upwards, with a dent across its arm.
BENT = ("coordsX*iHat + coordsY*jHat + (coordsZ + 0.004*(coordsX-2)*abs(coordsX-2)"
        " - 0.1*exp(-20*(coordsX-5.2)^2))*kHat")


def save(name, rectangle):
    """A part of the screen, as it is."""
    settled = QApplication.primaryScreen().grabWindow(
        0, rectangle.x(), rectangle.y(), rectangle.width(), rectangle.height())
    assert settled.save(str(FOLDER / name), "PNG", 0), f"cannot write {FOLDER / name}"
    return settled.toImage()


def place(widget):
    """Where a widget is on the screen."""
    return QRect(widget.mapToGlobal(QPoint(0, 0)), widget.size())


def picture_of_menu():
    """Filters > Footpoint, unrolled."""
    filters = window.menu("Filters")
    bar = window.main_window().menuBar()
    corner = bar.mapToGlobal(bar.actionGeometry(filters).bottomLeft())
    filters.menu().popup(corner)
    window.settle()
    category = window.menu("Filters", "Footpoint").menu()
    entry = filters.menu().actionGeometry(category.menuAction())
    category.popup(filters.menu().mapToGlobal(entry.topRight()))
    window.settle()
    category.setActiveAction(window.menu("Filters", "Footpoint", "Point Inversion"))
    window.settle()
    save("menu.png", place(bar).united(place(filters.menu())).united(place(category)) &
         QRect(0, 0, corner.x() + 560, place(category).bottom() + 60))
    category.close()
    filters.menu().close()
    window.settle()


def make_scan():
    """What a scanner would have made: a fine mesh of the bent rod, in a file."""
    rod = simple.CADReader(FileName=str(PART), AngularDeflection=6.0)
    fine = simple.Subdivide(Input=simple.OutputPort(rod, 0), NumberofSubdivisions=1)
    bent = simple.Calculator(Input=fine, CoordinateResults=1, Function=BENT)
    simple.SaveData(str(SCAN), bent)
    for source in (bent, fine, rod):
        simple.Delete(source)


def open_files():
    """Both, under the names that File > Open gives them."""
    rod = simple.CADReader(FileName=str(PART), registrationName=PART.name)
    scan = simple.XMLPolyDataReader(FileName=[str(SCAN)], registrationName=SCAN.name)
    simple.Show(simple.OutputPort(rod, 0))
    simple.Show(scan)
    simple.ResetCamera()
    simple.SetActiveSource(scan)
    window.settle()
    return rod, scan


def invert():
    """Point Inversion of the scan, by the menu and the dialog."""
    action = window.menu("Filters", "Footpoint", "Point Inversion")
    window.with_dialog(action.trigger, lambda dialog: window.answer_inputs(
        dialog, {"Input": SCAN.name, "Source": "Model"},
        lambda shown: save("inputs.png", place(shown))))
    window.settle()
    return simple.GetActiveSource()


def look_at(source, part):
    """The result alone, from above; a title that names the unit."""
    view = simple.GetActiveView()
    simple.LoadPalette("WhiteBackground")
    simple.Hide(part, view)
    legend = simple.GetScalarBar(simple.GetColorTransferFunction("SignedDistance"), view)
    legend.Title = "Deviation [mm]"
    legend.WindowLocation = "Upper Right Corner"
    view.CameraViewUp = [0, 0, 1]
    view.CameraFocalPoint = [5.6, 3.2, 1.0]
    view.CameraPosition = [7.0, -2.2, 8.0]
    simple.ResetCamera(view)
    simple.GetActiveCamera().Zoom(1.15)
    simple.Render(view)
    window.settle()


def picture_of_shape():
    """A teapot: its control net, which a source shows at first, beside the surface."""
    net = simple.NURBSShapeSource(Shape="Teapot")
    surface = simple.SplineTessellator(Input=net)
    layout = simple.CreateLayout("Shape")
    for k, (source, colour) in enumerate([(net, [0.2, 0.35, 0.6]), (surface, [0.45, 0.65, 0.9])]):
        view = simple.CreateRenderView(
            OrientationAxesVisibility=0, Background=[1, 1, 1], UseColorPaletteForBackground=0)
        simple.AssignViewToLayout(view, layout, k)
        if k == 0:
            layout.SplitHorizontal(0, 0.5)
        display = simple.Show(source, view)
        display.AmbientColor = display.DiffuseColor = colour
        display.LineWidth = 1.5
        view.CameraViewUp = [0, 0, 1]
        view.CameraFocalPoint = [0, 0, 1.5]
        view.CameraPosition = [3, -10, 6]
        simple.ResetCamera(view)
        view.CameraParallelProjection = 1
        view.CameraParallelScale = 2.5
    name = str(FOLDER / "shape.png")
    simple.SaveScreenshot(name, layout, ImageResolution=[900, 330], SeparatorWidth=0)
    halves = QImage(name)
    assert halves.size() == QSize(900, 330), halves.size()

    def is_blue(c):
        return c.blue() > c.red() + 30

    left, right = (share(halves.copy(QRect(x, 0, 450, 330)), is_blue) for x in (0, 450))
    assert 0.01 < left < 0.5 * right, f"blue {left:.3f} of the net, {right:.3f} of the surface"


def share(image, is_wanted):
    """The fraction of the pixels that are so."""
    pixels = [QColor(image.pixel(x, y)) for x in range(0, image.width(), 2)
              for y in range(0, image.height(), 2)]
    return sum(map(is_wanted, pixels)) / len(pixels)


FOLDER.mkdir(parents=True, exist_ok=True)
if not PART.exists() or not hasattr(simple, "CADReader"):
    print(f"skipped: no {PART}" if not PART.exists() else "skipped: built without Open CASCADE")
    sys.exit(125)
main = window.main_window()
main.resize(1180, 760)
main.resizeDocks([main.findChild(QDockWidget, "propertiesDock")], [380], Qt.Horizontal)
main.resizeDocks([main.findChild(QDockWidget, "pipelineBrowserDock")], [270], Qt.Vertical)
make_scan()
rod, scan = open_files()
picture_of_menu()
deviation = invert()
panel = window.Panel()
panel.set("DeviationTolerance", 0.05)
panel.apply()
panel.show_top()
look_at(deviation, rod)
image = save("window.png", place(main))

# What the picture is to show: the rod above and below the part, and the white behind it.
red = share(image, lambda c: c.red() > c.blue() + 60 and c.red() > c.green() + 60)
blue = share(image, lambda c: c.blue() > c.red() + 60 and c.blue() > c.green() + 60)
assert red > 0.01 and blue > 0.002, f"red {red:.4f}, blue {blue:.4f} of the window"
picture_of_shape()
print(f"4 pictures in {FOLDER}; red {red:.1%}, blue {blue:.1%} of the window")
