# SPDX-License-Identifier: BSD-3-Clause
"""A simulated optical scan of a bent part, with everything that real scans suffer from."""

from dataclasses import dataclass

import footpoint
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

# Lengths as fractions of the part's size.
NOISE = 1e-4  # standard deviation along the normal
BEND = 3e-3  # of the end that is farthest from the middle
OUTLIER_FRACTION = 0.002
OUTLIER_DISTANCES = (0.003, 0.04)  # uniform, in any direction
SHADOWS, SHADOW_RADIUS = 3, 0.09  # balls that the scanner did not see into
AIR = 1e-3  # above every point that can be seen
STIFF = 0.25  # what does not bend of the way from the middle to that end


@dataclass
class Scan:
    points: np.ndarray  # (m, 3)
    is_outlier: np.ndarray  # (m,) bool
    feet: np.ndarray  # (m, 3) what was scanned, on the nominal part
    deviations: np.ndarray  # (m,) by how much the bend moves that along the normal
    tip: np.ndarray  # (3,) the end that is bent, on the nominal part
    shift: np.ndarray  # (3,) by how much the bend moves that end
    noise: float  # standard deviation

    @property
    def worst(self):
        """The row that the bend moves most along the normal."""
        return np.abs(self.deviations).argmax()


def uniform_samples(mesh, count, random):
    """(count, 3) points that are spread evenly over the triangles."""
    corners = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)[
        vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    sides = corners[:, 1:] - corners[:, :1]
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    drawn = random.choice(len(corners), count, p=area / area.sum())
    weights = random.dirichlet((1.0, 1.0, 1.0), count)
    return np.einsum("ij,ijk->ik", weights, corners[drawn])


def bending(feet, height):
    """Displacements (m, 3) that bend the farthest end of a part across its thinnest direction, as a
    beam bends: with the square of the way from the middle, cross sections staying plane. Returns
    them, the end, and the displacement there.
    """
    offsets = feet - feet.mean(axis=0)
    _, directions = np.linalg.eigh(np.cov(offsets.T))
    thin = directions[:, 0] * np.sign(directions[np.abs(directions[:, 0]).argmax(), 0])
    flat = offsets - np.outer(offsets @ thin, thin)
    end = np.linalg.norm(flat, axis=1).argmax()
    length = np.linalg.norm(flat[end])
    along = flat[end] / length
    free = (1.0 - STIFF) * length
    way = np.clip((offsets @ along - STIFF * length) / free, 0.0, None)
    rise, slope = height * way**2, 2.0 * height * way / free
    shifts = np.outer(rise, thin) - np.outer(slope * (offsets @ thin), along)
    return shifts, feet[end], shifts[end]


def simulate(part, count, seed=2024):
    """Scans a bent Part at about `count` points. Returns a Scan."""
    random = np.random.default_rng(seed)
    samples = uniform_samples(part.mesh, count, random)
    exact = footpoint.invert(samples, part.model)  # the triangles are not the part
    feet, normals = exact.closest_points, exact.normals
    shifts, tip, shift = bending(feet, BEND * part.size)

    # === What the scanner sees
    candidates = feet[random.choice(count, 200, replace=False)]
    candidates = candidates[np.linalg.norm(candidates - tip, axis=1) > 0.4 * part.size][:SHADOWS]
    # Not where parts touch: there is no air above the face.
    air = AIR * part.size
    seen = footpoint.invert(feet + air * normals, part.model).signed_distance > 0.9 * air
    for centre in candidates:
        seen &= np.linalg.norm(feet - centre, axis=1) > SHADOW_RADIUS * part.size
    feet, normals, shifts = feet[seen], normals[seen], shifts[seen]

    # === Where it sees it
    noise = NOISE * part.size
    points = feet + shifts + random.normal(0.0, noise, (len(feet), 1)) * normals
    is_outlier = random.random(len(points)) < OUTLIER_FRACTION
    directions = random.normal(size=(is_outlier.sum(), 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    distances = part.size * random.uniform(*OUTLIER_DISTANCES, len(directions))
    points[is_outlier] += directions * distances[:, None]
    deviations = np.einsum("ij,ij->i", shifts, normals)
    return Scan(points, is_outlier, feet, deviations, tip, shift, noise)
