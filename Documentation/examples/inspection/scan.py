# SPDX-License-Identifier: BSD-3-Clause
"""A simulated optical scan of a surface, with everything that real scans suffer from."""

from dataclasses import dataclass

import footpoint
import numpy as np

NOISE = 0.01  # mm, standard deviation along the normal
OUTLIER_FRACTION = 0.005
OUTLIER_DISTANCES = (0.3, 4.0)  # mm, uniform, in any direction
SHADOW = (0.62, 0.66)  # range of v that the scanner did not see
DENT_CENTRE = (0.31, 0.36)  # (u, v), on the suction side
DENT_DEPTH = 0.15  # mm
DENT_RADIUS = 9.0  # mm


@dataclass
class Scan:
    points: np.ndarray  # (m, 3), mm
    is_outlier: np.ndarray  # (m,) bool
    dent_centre: np.ndarray  # (3,), mm, on the nominal surface


def tangents(surface, parameters):
    """∂S/∂u and ∂S/∂v, each (m, 3), by central differences; the domain is [0, 1]²."""
    step = 1e-6
    derivatives = []
    for direction in (np.array([step, 0.0]), np.array([0.0, step])):
        before = np.clip(parameters - direction, 0.0, 1.0)
        after = np.clip(parameters + direction, 0.0, 1.0)
        difference = footpoint.evaluate(surface, after) - footpoint.evaluate(surface, before)
        derivatives.append(difference / (after - before).sum(axis=1)[:, None])
    return derivatives


def uniform_samples(surface, count, random):
    """(count, 2) parameters that are spread evenly over the surface's area, and the unit normals.

    Parameters are drawn at random and kept in proportion to the area element.
    """
    parameters, normals = np.empty((0, 2)), np.empty((0, 3))
    while len(parameters) < count:
        drawn = random.random((4 * count, 2))
        drawn = drawn[(drawn[:, 1] < SHADOW[0]) | (drawn[:, 1] > SHADOW[1])]
        normal = np.cross(*tangents(surface, drawn))
        area = np.linalg.norm(normal, axis=1)
        kept = random.random(len(drawn)) * area.max() < area
        parameters = np.vstack([parameters, drawn[kept]])
        normals = np.vstack([normals, normal[kept] / area[kept, None]])
    return parameters[:count], normals[:count]


def dent_profile(points, parameters, centre):
    """Height of the damage at points of the surface: negative, smooth, zero beyond its radius."""
    distance = np.linalg.norm(points - centre, axis=1) / DENT_RADIUS
    inside = (distance < 1.0) & (parameters[:, 0] < 0.5)  # on one side of the blade only
    return np.where(inside, -DENT_DEPTH * (1.0 - np.minimum(distance, 1.0) ** 2) ** 2, 0.0)


def simulate(surface, count, seed=2024):
    """Scans a surface with domain [0, 1]² at `count` points. Returns a Scan."""
    random = np.random.default_rng(seed)
    parameters, normals = uniform_samples(surface, count, random)
    points = footpoint.evaluate(surface, parameters)
    centre = footpoint.evaluate(surface, np.array([DENT_CENTRE]))[0]
    height = dent_profile(points, parameters, centre) + random.normal(0.0, NOISE, count)
    points += height[:, None] * normals

    is_outlier = np.zeros(count, dtype=bool)
    is_outlier[random.choice(count, round(OUTLIER_FRACTION * count), replace=False)] = True
    directions = random.normal(size=(is_outlier.sum(), 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    points[is_outlier] += directions * random.uniform(*OUTLIER_DISTANCES, len(directions))[:, None]
    return Scan(points, is_outlier, centre)
