# SPDX-License-Identifier: BSD-3-Clause
"""A histogram of deviations with a logarithmic count axis, percentiles and tolerance limits."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartLegend, vtkChartXY
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkRenderingContext2D import vtkContextActor, vtkPen

BINS = 60
PERCENTILES = (5.0, 50.0, 95.0)
DARK = (0.13, 0.15, 0.18)


def table(**columns):
    """A vtkTable of equally long arrays."""
    result = vtkTable()
    for name, values in columns.items():
        array = numpy_to_vtk(np.asarray(values, dtype=float), deep=True)
        array.SetName(name)
        result.AddColumn(array)
    return result


def style_axis(axis, title, positions, labels, limits):
    """An axis with a title, labels of our own and fixed limits."""
    axis.SetTitle(title)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetRange(*limits)
    ticks = vtkDoubleArray()
    names = vtkStringArray()
    for position, label in zip(positions, labels):
        ticks.InsertNextValue(position)
        names.InsertNextValue(label)
    axis.SetCustomTickPositions(ticks, names)
    for style, size in ((axis.GetTitleProperties(), 18), (axis.GetLabelProperties(), 16)):
        style.SetFontFamilyToArial()
        style.SetFontSize(size)
        style.SetBold(0)
        style.SetColor(DARK)
    axis.GetGridPen().SetColor(225, 228, 232, 255)


def add_vertical(chart, x, top, label, colour, pen):
    """A vertical line at x, named in the legend."""
    line = chart.AddPlot(vtkChart.LINE)
    line.SetInputData(table(x=[x, x], y=[0.0, top]), 0, 1)
    line.SetLabel(label)
    line.SetColor(*colour, 255)
    line.SetWidth(2.0)
    line.GetPen().SetLineType(pen)


def add_histogram(renderer, deviations, colours, limit, tolerance):
    """Draws the histogram of deviations in mm within ±limit into the renderer's viewport.

    Bars stand for log10(count), so that a few points in a dent show beside thousands of good ones.
    """
    counts, edges = np.histogram(deviations, bins=BINS, range=(-limit, limit))
    decades = int(np.ceil(np.log10(max(counts.max(), 10))))
    top = decades + 0.2

    chart = vtkChartXY()
    chart.SetRenderEmpty(True)
    centres = 0.5 * (edges[:-1] + edges[1:])
    # One more than log10, so that a single point is seen too.
    heights = np.where(counts > 0, np.log10(np.maximum(counts, 1)), 0.0)
    heights = np.where(counts == 1, 0.06, heights)
    bars = chart.AddPlot(vtkChart.BAR)
    bars.SetInputData(table(x=centres, height=heights, colour=centres), 0, 1)
    bars.SetLabel("")
    bars.SetLegendVisibility(False)
    bars.ScalarVisibilityOn()
    bars.SetLookupTable(colours)
    bars.SelectColorArray("colour")
    bars.GetPen().SetLineType(vtkPen.NO_PEN)

    add_vertical(chart, -tolerance, top, f"Tolerance \u00b1{tolerance:.2f}", (190, 60, 30), vtkPen.SOLID_LINE)
    add_vertical(chart, tolerance, top, "", (190, 60, 30), vtkPen.SOLID_LINE)
    for percentile in PERCENTILES:
        value = np.percentile(deviations, percentile)
        add_vertical(chart, value, top, f"P{percentile:.0f}  {value:+.3f}".replace("-", "\u2212"),
                     (60, 65, 75), vtkPen.DASH_LINE)

    width = 2.0 * limit / BINS
    steps = np.linspace(-limit, limit, 7)
    style_axis(chart.GetAxis(vtkAxis.BOTTOM), "Deviation [mm]", steps,
               [f"{step:+.2f}".replace("-", "\u2212") for step in steps], (-limit, limit))
    style_axis(chart.GetAxis(vtkAxis.LEFT), f"Points per {1000.0 * width:.0f} \u00b5m",
               range(decades + 1), [f"{10**decade:,}" for decade in range(decades + 1)], (0.0, top))
    chart.SetShowLegend(True)
    legend = chart.GetLegend()
    legend.SetInline(True)
    legend.SetHorizontalAlignment(vtkChartLegend.RIGHT)
    legend.SetVerticalAlignment(vtkChartLegend.TOP)
    legend.GetLabelProperties().SetFontSize(15)

    actor = vtkContextActor()
    actor.GetScene().AddItem(chart)
    renderer.AddActor(actor)
    actor.GetScene().SetRenderer(renderer)
