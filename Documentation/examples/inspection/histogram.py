# SPDX-License-Identifier: BSD-3-Clause
"""A histogram of deviations with a logarithmic count axis, percentiles and tolerance limits."""

import numpy as np

from .drawing import (
    DARK, GREY, PALE, RED, add_dashes, add_line, add_rectangles, add_text, signed)

BINS = 80
PERCENTILES = ((5, "Right"), (50, "Centered"), (95, "Left"))  # and where the label stands


def colour_of(colours, value):
    """(r, g, b) of a vtkColorTransferFunction, clamped to its range."""
    return colours.GetColor(float(np.clip(value, *colours.GetRange())))


def add_histogram(page, frame, deviations, colours, limit, tolerance):
    """Draws the histogram of deviations in mm within ±limit.

    frame: (x0, y0, x1, y1) of the plot area in pixels of the page; labels stand around it.
    Counts are logarithmic, so that a few points in a dent show beside thousands of good ones.
    """
    left, bottom, right, top = frame
    counts, edges = np.histogram(deviations, bins=BINS, range=(-limit, limit))
    decades = int(np.ceil(np.log10(max(counts.max(), 10))))
    decade = (top - bottom) / (decades + 0.15)  # pixels, over half of one for the count 1

    def across(value):
        return left + (value + limit) / (2.0 * limit) * (right - left)

    def up(count):
        return bottom + decade * (np.log10(count) + 0.15)

    # === The count axis
    for exponent in range(decades + 1):
        y = up(10.0**exponent)
        add_line(page, [(left, y), (right, y)], colour=PALE, width=1.0)
        add_text(page, f"{10**exponent:,}", left - 8, y - 6, size=16, justify="Right")
    bin_width = 2000.0 * limit / BINS
    add_text(page, f"Points per {bin_width:.0f} \u00b5m of deviation", left - 66,
             0.5 * (bottom + top), size=18, justify="Centered", angle=90.0)

    # === The bars
    shown = counts > 0
    bars = [(across(a) + 0.5, bottom, across(b) - 0.5, up(count))
            for a, b, count in zip(edges[:-1][shown], edges[1:][shown], counts[shown])]
    middles = 0.5 * (edges[:-1] + edges[1:])[shown]
    add_rectangles(page, bars, [colour_of(colours, middle) for middle in middles])

    # === Percentiles and tolerance
    for percentile, side in PERCENTILES:
        x = across(np.percentile(deviations, percentile))
        add_dashes(page, (x, bottom), (x, top), colour=GREY)
        y = top + (23 if side == "Centered" else 7)
        add_text(page, f"P{percentile}", x, y, size=14, justify=side)
    for sign in (-1.0, 1.0):
        x = across(sign * tolerance)
        add_line(page, [(x, bottom), (x, top)], colour=RED, width=2.0)
        add_text(page, f"Tol. {signed(sign * tolerance, 2)}", x, top + 7, size=14, colour=RED,
                 justify="Right" if sign < 0 else "Left")

    # === The deviation axis
    add_line(page, [(left, top), (left, bottom), (right, bottom)], colour=DARK)
    for value in np.linspace(-limit, limit, 5):
        x = across(value)
        add_line(page, [(x, bottom), (x, bottom - 5)])
        add_text(page, signed(value, 2), x, bottom - 23, size=16, justify="Centered")
    add_text(page, "Deviation [mm], all points", 0.5 * (left + right), bottom - 48, size=18,
             justify="Centered")
