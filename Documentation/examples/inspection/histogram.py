# SPDX-License-Identifier: BSD-3-Clause
"""A histogram of deviations with a logarithmic count axis and tolerance limits."""

import numpy as np

from .drawing import DARK, PALE, RED, add_line, add_rectangles, add_text

BINS = 80


def colour_of(colours, value):
    """(r, g, b) of a vtkColorTransferFunction, clamped to its range."""
    return colours.GetColor(float(np.clip(value, *colours.GetRange())))


def add_histogram(page, frame, deviations, colours, lengths):
    """Draws the histogram of deviations; what is beyond its limit counts at its ends.

    frame: (x0, y0, x1, y1) of the plot area in pixels of the page; labels stand around it.
    Counts are logarithmic, so that a few points in a dent show beside thousands of good ones.
    """
    left, bottom, right, top = frame
    limit, tolerance = lengths.histogram_limit, lengths.tolerance
    counts, edges = np.histogram(
        np.clip(deviations, -limit, limit), bins=BINS, range=(-limit, limit))
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
    add_text(page, f"Points per {2.0 * limit / BINS:.3g} {lengths.unit}", left - 66,
             0.5 * (bottom + top), size=18, justify="Centered", angle=90.0)

    # === The bars
    shown = counts > 0
    bars = [(across(a) + 0.5, bottom, across(b) - 0.5, up(count))
            for a, b, count in zip(edges[:-1][shown], edges[1:][shown], counts[shown])]
    middles = 0.5 * (edges[:-1] + edges[1:])[shown]
    add_rectangles(page, bars, [colour_of(colours, middle) for middle in middles])

    # === Tolerance
    for sign in (-1.0, 1.0):
        x = across(sign * tolerance)
        add_line(page, [(x, bottom), (x, top)], colour=RED, width=2.0)
        add_text(page, f"Tol. {lengths.tick(sign * tolerance, tolerance)}", x, top + 7, size=14,
                 colour=RED, justify="Right" if sign < 0 else "Left")

    # === The deviation axis
    add_line(page, [(left, top), (left, bottom), (right, bottom)], colour=DARK)
    for value in np.linspace(-limit, limit, 5):
        x = across(value)
        add_line(page, [(x, bottom), (x, bottom - 5)])
        add_text(page, lengths.tick(value, limit), x, bottom - 23, size=16, justify="Centered")
    add_text(page, f"Deviation [{lengths.unit}], without outliers", 0.5 * (left + right),
             bottom - 48, size=18, justify="Centered")
