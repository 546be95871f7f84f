# SPDX-License-Identifier: BSD-3-Clause
"""How lengths are written and coloured: unit, digits, and the ends of the scales."""

import math
from dataclasses import dataclass

import numpy as np

from .drawing import signed


def round_up(value, steps=(1.0, 2.0, 4.0, 5.0, 8.0, 10.0)):
    """The next number of those steps times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * next(step for step in steps if step >= value / power * (1.0 - 1e-9))


@dataclass
class Lengths:
    unit: str
    tolerance: float
    colour_limit: float  # end of the colours
    histogram_limit: float

    @property
    def digits(self):
        """Decimals that show a thousandth of the tolerance."""
        return max(0, 3 - math.floor(math.log10(self.tolerance)) - 1)

    def text(self, value, fewer=0):
        """A length with its unit, with a few decimals less."""
        return f"{value:.{max(0, self.digits - fewer)}f} {self.unit}".replace("-", "\u2212")

    def signed(self, value, fewer=0):
        return f"{signed(value, max(0, self.digits - fewer))} {self.unit}"

    def point(self, position):
        """Coordinates, to the tolerance's first digit."""
        decimals = max(0, self.digits - 2)
        numbers = ", ".join(f"{x:.{decimals}f}" for x in position).replace("-", "\u2212")
        return f"({numbers}) {self.unit}"

    def tick(self, value, limit):
        """A number on an axis that ends at the limit."""
        return signed(value, max(0, 1 - math.floor(math.log10(limit))))


def lengths_for(unit, tolerance, deviations):
    """Scales that show the tolerance and nearly all deviations; these are without outliers."""
    magnitude = np.abs(deviations)
    colour = max(2.0 * tolerance, min(10.0 * tolerance, np.percentile(magnitude, 99.5)))
    colour = round_up(colour)
    return Lengths(unit, tolerance, colour,
                   round_up(max(1.2 * colour, np.percentile(magnitude, 99.9))))
