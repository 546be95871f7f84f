# SPDX-License-Identifier: BSD-3-Clause
"""Patches, surfaces through curves, volumes and smoothing from arrays: closed forms, all orders and
directions, real boundaries and networks of curves.
"""

import itertools
import json
import os
from pathlib import Path
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import footpoint

DATA = Path(os.environ.get("FOOTPOINT_SHARED_DATA", ""))
SAMPLES = 41
#: Boundaries that are given by one curve each, and folded by plain interpolation.
FOLDED = {"gismo__butterfly_bdry.xml"}


def points_of(grid):
    """(nu, nv[, nw], 3) array."""
    dimensions = [n for n in grid.GetDimensions() if n > 1]
    points = vtk_to_numpy(grid.GetPoints().GetData()).reshape(*dimensions[::-1], 3)
    return points.transpose(*range(len(dimensions))[::-1], len(dimensions))


def field(grid, name):
    return vtk_to_numpy(grid.GetFieldData().GetArray(name))


def sides_of(surface, count=11):
    """bottom, right, top, left of a function of two arrays."""
    t = np.linspace(0, 1, count)
    zero, one = np.zeros(count), np.ones(count)
    corners = (t, zero), (one, t), (t, one), (zero, t)
    return [np.column_stack(np.broadcast_arrays(*surface(u, v))) for u, v in corners]


def swan(count=21):
    return sides_of(
        lambda u, v: (u * (1 + 2 * v - 2 * v * v), v * (1 - 3 * u + 3 * u * u), 0.0), count
    )


def curve(record):
    cp = np.asarray(record["cp"], dtype=float)
    weights = cp[:, 3] if np.ptp(cp[:, 3]) > 0 else None
    return footpoint.nurbs_curve(cp[:, :3], record["knots"], weights)


def sample(record, count=SAMPLES):
    knots, degree = record["knots"], record["degree"]
    parameters = np.linspace(knots[degree], knots[-degree - 1], count)
    return footpoint.evaluate(curve(record), parameters)


class Patches(unittest.TestCase):
    def test_product(self):
        def surface(u, v):
            return u, v, u * v

        grid = footpoint.coons_patch(*sides_of(surface), resolution=(11, 11))
        u, v = np.meshgrid(np.linspace(0, 1, 11), np.linspace(0, 1, 11), indexing="ij")
        expected = np.stack(surface(u, v), axis=-1)
        np.testing.assert_allclose(points_of(grid), expected, rtol=0, atol=1e-15)

    def test_centre_of_square_of_product(self):
        sides = sides_of(lambda u, v: (u, v, u * u * v * v))
        grid = footpoint.coons_patch(*sides, resolution=(21, 21))
        self.assertAlmostEqual(points_of(grid)[10, 10, 2], 0.0, delta=1e-15)

    def test_all_orders_and_directions(self):
        sides = sides_of(
            lambda u, v: (3 * u + 0.3 * v * u - 0.2 * v, v + u * v + 0.2 * u * (1 - u), 0.1 * u)
        )
        expected = points_of(footpoint.coons_patch(*sides, resolution=(9, 7)))
        count = 0
        for order in itertools.permutations(range(4)):
            for flips in itertools.product((1, -1), repeat=4):
                given = [sides[k][::flip] for k, flip in zip(order, flips)]
                grid = footpoint.coons_patch(*given, resolution=(9, 7))
                np.testing.assert_array_equal(points_of(grid), expected)
                self.assertEqual(field(grid, "EdgeOrder")[list(order)].tolist(), [0, 1, 2, 3])
                count += 1
        self.assertEqual(count, 24 * 16)

    def test_two_columns_and_collapsed_side(self):
        bottom, right, left = [[0, 0], [2, 0]], [[2, 0], [1, 2]], [[0, 0], [1, 2]]
        grid = footpoint.coons_patch(bottom, right, None, left, resolution=(5, 5))
        self.assertEqual(np.sum(field(grid, "EdgeOrder") == -1), 1)
        self.assertTrue((points_of(grid)[..., 2] == 0).all())

    def test_own_samples(self):
        bottom, right, top, left = sides_of(lambda u, v: (u, v, 0.0), 5)
        top = np.column_stack([np.linspace(0, 1, 8), np.ones(8), np.zeros(8)])
        grid = footpoint.coons_patch(bottom, right, top, left, resolution=(0, 0))
        self.assertEqual(grid.GetDimensions(), (8, 5, 1))

    def test_swan(self):
        grid = footpoint.coons_patch(*swan())
        self.assertEqual(field(grid, "FoldedCellsBefore")[0], 18)
        mended = footpoint.coons_patch(*swan(), smoothing="Auto")
        self.assertEqual(field(mended, "FoldedCellsAfter")[0], 0)
        again = footpoint.smooth_grid(grid)
        np.testing.assert_array_equal(points_of(again), points_of(mended))
        from_array = footpoint.smooth_grid(points_of(grid))
        np.testing.assert_array_equal(points_of(from_array), points_of(mended))

    def test_errors(self):
        sides = sides_of(lambda u, v: (u, v, 0.0))
        gap = [side.copy() for side in sides]
        gap[2][-1, 0] += 0.1
        with self.assertRaisesRegex(ValueError, "0.1"):
            footpoint.coons_patch(*gap)
        with self.assertRaisesRegex(ValueError, r"bottom has shape \(4,\)"):
            footpoint.coons_patch([1, 2, 3, 4], *sides[1:])
        with self.assertRaisesRegex(TypeError, "no option 'resolutoin'.*resolution"):
            footpoint.coons_patch(*sides, resolutoin=(5, 5))
        with self.assertRaisesRegex(TypeError, "resolution"):
            footpoint.coons_patch(*sides, resolution=(5.5, 5))
        with self.assertRaises(ValueError):
            footpoint.coons_patch(sides[0], sides[2], sides[1], sides[3], strict=True)


class Curves(unittest.TestCase):
    def test_coons_surface_of_lines(self):
        corners = [[0, 0, 0], [2, 0, 1], [2, 1, 0], [0, 1, 3]]
        a, b, c, d = corners
        lines = [footpoint.nurbs_curve(ends, [0, 0, 1, 1]) for ends in ([a, b], [c, b], [d, c], [d, a])]
        net = footpoint.coons_surface(*lines)
        np.testing.assert_allclose(
            footpoint.evaluate(net, [[0.5, 0.5]]), [np.mean(corners, axis=0)], atol=1e-15
        )
        np.testing.assert_array_equal(field(net, "EdgeReversed"), [0, 1, 0, 1])
        with self.assertRaisesRegex(ValueError, "same edge"):
            footpoint.coons_surface(lines[0], lines[1], lines[2], lines[0])
        far = footpoint.nurbs_curve([[0, 1, 3], [0, 0, 1]], [0, 0, 1, 1])
        with self.assertRaisesRegex(ValueError, "apart"):
            footpoint.coons_surface(lines[0], lines[1], lines[2], far)

    def test_gordon_surface(self):
        t = np.linspace(0, 1, 4)

        def cubic(points):
            basis = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3], 1)
            return footpoint.nurbs_curve(np.linalg.solve(basis, points), [0] * 4 + [1] * 4)

        def surface(u, v):
            return np.column_stack(
                np.broadcast_arrays(2 * u, 1.5 * v - 0.1 * u**3, u * u * v - 0.5 * v**3 * u)
            )

        profiles = [cubic(surface(t, v)) for v in (0.0, 1.0, 0.4, 0.7)]
        guides = [cubic(surface(u, t)) for u in (0.25, 0.0, 0.6, 1.0)]
        net = footpoint.gordon_surface(profiles, guides)
        uv = np.random.default_rng(1).random((50, 2))
        np.testing.assert_allclose(
            footpoint.evaluate(net, uv), surface(*uv.T), rtol=0, atol=1e-11
        )
        self.assertEqual(field(net, "ProfileOrder").tolist(), [0, 2, 3, 1])
        with self.assertRaises(ValueError):
            footpoint.gordon_surface(profiles[:1], guides)

    def test_gordon_surface_of_closed_profiles(self):
        angles = np.arange(9) * np.pi / 4
        weights = np.where(np.arange(9) % 2, np.sqrt(0.5), 1)
        ring = np.column_stack([np.cos(angles), np.sin(angles)]) / weights[:, None]
        knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
        profiles = [
            footpoint.nurbs_curve(np.column_stack([ring, np.full(9, z)]), knots, weights)
            for z in (0.0, 2.0)
        ]
        guides = [
            footpoint.nurbs_curve([[c, s, 0], [c, s, 2]], [0, 0, 1, 1])
            for c, s in [(np.cos(a), np.sin(a)) for a in (1.0, 3.0, 5.0)]
        ]
        net = footpoint.gordon_surface(profiles, guides)
        uv = np.random.default_rng(1).random((50, 2))
        xyz = footpoint.evaluate(net, uv)
        np.testing.assert_allclose(np.hypot(xyz[:, 0], xyz[:, 1]), 1, rtol=0, atol=1e-13)
        np.testing.assert_allclose(xyz[:, 2], 2 * uv[:, 1], rtol=0, atol=1e-13)
        self.assertEqual(field(net, "GuideOrder").tolist(), [0, 1, 2, 0])
        self.assertEqual(field(net, "ParametersU")[[0, -1]].tolist(), [0, 1])


class Volumes(unittest.TestCase):
    def faces(self, map_, count=5):
        t = np.linspace(0, 1, count)
        a, b = np.meshgrid(t, t, indexing="ij")
        sides = [(k + 0 * a, a, b) for k in (0, 1)]
        sides += [(a, k + 0 * a, b) for k in (0, 1)]
        sides += [(a, b, k + 0 * a) for k in (0, 1)]
        return [np.stack(map_(*side), axis=-1) for side in sides]

    def test_square_of_product(self):
        faces = self.faces(lambda u, v, w: (u + u * u * v * v * w * w, v, w))
        grid = footpoint.transfinite_volume(faces)
        self.assertEqual(grid.GetDimensions(), (5, 5, 5))
        self.assertAlmostEqual(points_of(grid)[2, 2, 2, 0], 0.5 + 1 / 32, delta=1e-14)
        self.assertEqual(field(grid, "FoldedCells")[0], 0)

    def test_edges(self):
        corners = list(itertools.product((0, 1), repeat=2))
        edges = [[[0, v, w], [1, v, w]] for w, v in corners]
        edges += [[[u, 0, w], [u, 1, w]] for w, u in corners]
        edges += [[[u, v, 0], [u, v, 1]] for v, u in corners]
        grid = footpoint.transfinite_volume(edges)
        self.assertEqual(points_of(grid)[1, 0, 1].tolist(), [1, 0, 1])
        with self.assertRaisesRegex(ValueError, "there are 0 and 11|there are 11"):
            footpoint.transfinite_volume([np.zeros((2, 2, 3))] * 11)


@unittest.skipUnless((DATA / "coons").is_dir(), "no FOOTPOINT_SHARED_DATA")
class RealBoundaries(unittest.TestCase):
    def boundaries(self):
        for path in sorted((DATA / "coons").glob("*.json")):
            for record in json.loads(path.read_text(encoding="utf-8")):
                yield record

    def test_patches(self):
        count = refused = 0
        for record in self.boundaries():
            name = f"{record['source']} {record['name']}"
            sides = [sample(c) for c in record["curves"]]
            with self.subTest(name):
                count += 1
                try:
                    grid = footpoint.coons_patch(*sides)
                except ValueError as error:
                    refused += 1
                    print(f"{name}: refused: {error}")
                    self.assertRegex(str(error), r"polyline|side|corner|apart")
                    continue
                self.assertTrue(np.isfinite(points_of(grid)).all())
                folds = field(grid, "FoldedCellsBefore")[0]
                mended = footpoint.coons_patch(*sides, smoothing="Auto")
                after = field(mended, "FoldedCellsAfter")[0]
                print(f"{name}: {folds} folded cells, after smoothing {after}")
                self.assertLessEqual(after, folds)
                if record["source"] in FOLDED:
                    self.assertGreater(folds, 0)
                    self.assertEqual(after, 0)
        self.assertGreater(count, 10)
        self.assertLess(refused, count)

    def test_exact_surfaces(self):
        for record in self.boundaries():
            name = f"{record['source']} {record['name']}"
            with self.subTest(name):
                curves = [curve(c) for c in record["curves"]]
                try:
                    net = footpoint.coons_surface(*curves)
                except ValueError as error:
                    print(f"{name}: refused: {error}")
                    self.assertRegex(str(error), r"polyline|side|corner|apart|meet")
                    continue
                on_side = np.column_stack([np.linspace(0, 1, SAMPLES), np.zeros(SAMPLES)])
                bottom = footpoint.evaluate(net, on_side)
                given = sample(record["curves"][field(net, "EdgeOrder")[0]])
                if field(net, "EdgeReversed")[0]:
                    given = given[::-1]
                size = np.linalg.norm(np.ptp(bottom, axis=0))
                np.testing.assert_allclose(bottom, given, rtol=0, atol=1e-11 * size)

    def test_networks(self):
        for name in ("nacelle", "spiralwing"):
            families = []
            for family in ("profiles", "guides"):
                path = DATA / "json" / f"tigl__net_{name}_{family}.brep.jsonl"
                text = path.read_text(encoding="utf-8")
                records = [json.loads(line) for line in text.splitlines()]
                families.append([curve(r) for r in records if r["type"] == "edge"])
            with self.subTest(name):
                net = footpoint.gordon_surface(
                    *families, reparametrize=True, reparametrization_tolerance=1e-3
                )
                gap, change = field(net, "LargestGap")[0], field(net, "ReparametrizationError")[0]
                print(f"{name}: {net.GetDimensions()}, gap {gap:.3g}, change {change:.3g}")
                size = np.linalg.norm(np.subtract(net.GetBounds()[1::2], net.GetBounds()[::2]))
                self.assertLess(change, 1e-3 * size)
                if name == "spiralwing":
                    self.assertEqual(field(net, "GuideOrder").tolist(), [0, 1, 2])
                    ends = [[u, v] for v in np.linspace(0, 1, 9) for u in (0, 1)]
                    xyz = footpoint.evaluate(net, ends)
                    np.testing.assert_allclose(xyz[::2], xyz[1::2], rtol=0, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
