# SPDX-License-Identifier: BSD-3-Clause
"""Real models: faces and edges load and evaluate, their points are found again; teapot and propeller
blades without a point that does not converge; published parameters; a scan against its surface.
"""

import unittest

import numpy as np

import footpoint
from shared_data import domain, folder, make_curve, make_face, records, size

DATA = folder()
JSON = DATA / "json"


def random_parameters(record, count, generator):
    """Inside, and with a tenth each on the borders of the domain."""
    low, high = domain(record)
    fractions = generator.random((count, len(low)))
    for side in (0.0, 1.0):
        rows = generator.random((count, len(low))) < 0.1
        fractions[rows] = side
    return np.minimum(low + fractions * (high - low), high)


class Models(unittest.TestCase):
    """On-surface and on-curve points of every face and edge: distance <= 1e-13 of the size."""

    TOLERANCE = 1e-13
    POINTS = 40

    def check(self, kind, make):
        generator = np.random.default_rng(1)
        worst, count, failures = 0.0, 0, []
        for path in sorted(JSON.glob("*.jsonl")):
            for number, record in enumerate(records(path, kind)):
                geometry = make(record)
                parameters = random_parameters(record, self.POINTS, generator)
                points = footpoint.evaluate(geometry, parameters)
                self.assertTrue(np.isfinite(points).all(), f"{path.name} {kind} {number}")
                r = footpoint.invert(points, geometry)
                relative = r.distance / size(geometry)
                # Far from the origin the points themselves are rounded.
                allowed = np.maximum(
                    self.TOLERANCE, 4 * np.spacing(np.abs(points).max()) / size(geometry)
                )
                for i in np.flatnonzero((relative > allowed) | (r.status > 1)):
                    failures.append(
                        f"{path.name} {kind} {number}: at {parameters[i].tolist()} distance "
                        f"{relative[i]:.3g} of the size, status {r.status[i]}, found "
                        f"{r.parameters[i].tolist()} after {r.iterations[i]} iterations"
                    )
                worst = max(worst, np.nanmax(relative))
                count += 1
        print(f"{count} {kind}s: worst distance of a point on it {worst:.2g} of the size")
        self.assertEqual(len(failures), 0, "\n" + "\n".join(failures[:40]))

    def test_faces(self):
        self.check("face", make_face)

    def test_edges(self):
        self.check("edge", make_curve)


    def test_parameters_come_back(self):
        """Inside, where these models are regular, parameters return to 1e-10 of the domain."""
        generator = np.random.default_rng(7)
        worst, count = 0.0, 0
        for path in sorted(JSON.glob("*.jsonl")):
            for kind, make in (("face", make_face), ("edge", make_curve)):
                for number, record in enumerate(records(path, kind)):
                    geometry, (low, high) = make(record), domain(record)
                    fractions = generator.uniform(0.001, 0.999, (30, len(low)))
                    parameters = low + fractions * (high - low)
                    r = footpoint.invert(footpoint.evaluate(geometry, parameters), geometry)
                    error = np.abs(r.parameters - parameters) / (high - low)
                    where = f"{path.name} {kind} {number}: {parameters[error.max(axis=1).argmax()]}"
                    self.assertLessEqual(error.max(), 1e-10, where)
                    worst, count = max(worst, error.max()), count + len(parameters)
        print(f"parameters of {count} points: worst error {worst:.2g} of the domain")


class NoPointUnconverged(unittest.TestCase):
    """On, near, off and far points of whole models: Status 2 (NotConverged) never occurs."""

    POINTS = 400

    def queries(self, faces, kind_of_points, generator):
        """Points on random faces, moved along the normal, and around the model."""
        scale = size(*[make_face(f) for f in faces])
        on, normals = [], []
        for record in (faces[i] for i in generator.integers(len(faces), size=25)):
            parameters = random_parameters(record, self.POINTS // 25, generator)
            r = footpoint.invert(
                footpoint.evaluate(make_face(record), parameters), make_face(record)
            )
            on.append(r.closest_points)
            normals.append(np.nan_to_num(r.normals))
        on, normals = np.concatenate(on), np.concatenate(normals)
        if kind_of_points == "on":
            return on
        if kind_of_points == "near":
            return on + 1e-6 * scale * generator.choice([-1, 1], (len(on), 1)) * normals
        if kind_of_points == "off":
            return on + 0.1 * scale * generator.normal(size=on.shape)
        directions = generator.normal(size=on.shape)
        return on + 10 * scale * directions / np.linalg.norm(directions, axis=1)[:, None]

    def check(self, pattern):
        for path in sorted(JSON.glob(pattern)):
            faces = records(path, "face")
            model = [make_face(f) for f in faces]
            generator = np.random.default_rng(2)
            for kind in ("on", "near", "off", "far"):
                points = self.queries(faces, kind, generator)
                results = {}
                for search in ("Global", "Seeded"):
                    r = results[search] = footpoint.invert(points, model, search=search)
                    where = f"{path.name}, {kind} points, {search}"
                    print(
                        f"{where}: status counts {r.statistics['status_counts'].tolist()}, "
                        f"iterations at most {r.iterations.max()}, on average "
                        f"{r.iterations.mean():.1f}"
                    )
                    bad = np.flatnonzero(r.status > 1)
                    self.assertEqual(
                        len(bad), 0, f"{where}: {points[bad].tolist()}, faces {r.face[bad]}"
                    )
                self.compare(results, size(*model), f"{path.name}, {kind} points")
                if kind == "on":
                    on_it = results["Global"].distance.max() / size(*model)
                    self.assertLessEqual(on_it, 1e-13, path.name)

    def compare(self, results, scale, where):
        """Seeds alone may miss the nearest point; the global search never finds a farther one."""
        excess = (results["Seeded"].distance - results["Global"].distance) / scale
        print(f"{where}: Seeded is farther at {np.sum(excess > 1e-12)} of {len(excess)}")
        self.assertGreaterEqual(excess.min(), -1e-12, f"{where}, point {excess.argmin()}")

    def test_teapot(self):
        self.check("gismo__teapot.xml.jsonl")

    def test_propeller(self):
        self.check("bladex__*.jsonl")


class PublishedParameters(unittest.TestCase):
    """Parameters that other programs' tests expect."""

    def test_surface(self):
        record = records(JSON / "anurbs__point_on_surface_projection.ibra.jsonl", "face")[0]
        net = make_face(record)
        expected = np.loadtxt(
            DATA / "points" / "surface_projection_expected_uv.csv", delimiter=",", skiprows=1
        )
        low, high = domain(record)
        self.assertEqual(expected.shape, (100, 2))
        r = footpoint.invert(footpoint.evaluate(net, expected), net)
        error = np.abs(r.parameters - expected) / (high - low)
        print(
            f"100 points of a surface: parameters to {error.max():.2g} of the domain, distance "
            f"{r.distance.max() / size(net):.2g} of the size, iterations {r.iterations.mean():.1f}"
        )
        self.assertLessEqual(error.max(), 1e-10)
        self.assertLessEqual(r.distance.max() / size(net), 1e-13)

    def test_curve(self):
        # The header of the file: openNURBS knots, without the first and the last.
        poles = [(0, -25, -5), (-15, -15, 0), (5, -5, -3), (15, -15, 3), (25, 0, 6), (15, 15, 6),
                 (-5, -5, -3), (-25, 15, 4)]
        knots = [3, 3, 3, 3, 3, 6.5, 10, 13.5, 17, 17, 17, 17, 17]
        rows = np.loadtxt(
            DATA / "points" / "curve_projection_expected.csv", delimiter=",", skiprows=2
        )
        points, expected = rows[:, :3], rows[:, 3]
        curve = footpoint.nurbs_curve(poles, knots)
        r = footpoint.invert(points, curve)
        # Never is the point at the file's parameter nearer than ours.
        theirs = np.linalg.norm(footpoint.evaluate(curve, expected) - points, axis=1)
        error = np.abs(r.parameters[:, 0] - expected) / 14
        at_end = np.isin(r.parameters[:, 0], [3.0, 17.0])
        print(
            f"{len(rows)} points off a curve: parameters to {error.max():.2g} of the domain, "
            f"{at_end.sum()} of them at an end, distances {(theirs - r.distance).min():.2g} to "
            f"{(theirs - r.distance).max():.2g} below the expected"
        )
        self.assertEqual(len(rows), 100)
        self.assertGreaterEqual((theirs - r.distance).min(), -1e-12)
        self.assertLessEqual(error.max(), 1e-10, f"points {np.flatnonzero(error > 1e-10)}")
        self.assertEqual(at_end.sum(), 31)
        np.testing.assert_array_equal(at_end, np.isin(expected, [3.0, 17.0]))
        np.testing.assert_array_equal(at_end, r.foot_type == footpoint.FootType.VERTEX)


class Scan(unittest.TestCase):
    def test_valve(self):
        record = records(JSON / "nurbsdiff__valve_smesh.1.dat.jsonl", "face")[0]
        net = make_face(record)
        points = np.loadtxt(DATA / "points" / "valve_data.1.txt")
        r = footpoint.invert(points, net)
        relative = r.distance / size(net)
        print(
            f"{len(points)} points of a scanned valve, percent of the size away: percentiles 0, 25, "
            f"50, 75, 100 {np.percentile(100 * relative, [0, 25, 50, 75, 100]).round(2).tolist()}"
        )
        self.assertTrue((r.status <= 1).all())
        # The judge is a dense grid: no sample is nearer than the foot, and one is close to it.
        samples = 300
        low, high = domain(record)
        u, v = np.meshgrid(*np.linspace(low, high, samples).T, indexing="ij")
        grid = footpoint.evaluate(net, np.column_stack([u.ravel(), v.ravel()]))
        mesh = grid.reshape(samples, samples, 3)
        cell = max(
            np.linalg.norm(np.diff(mesh, axis=axis), axis=2).max() for axis in (0, 1)
        )
        for i, point in enumerate(points):
            nearest = np.linalg.norm(grid - point, axis=1).min()
            self.assertLessEqual(r.distance[i], nearest * (1 + 1e-12), f"point {i}")
            self.assertGreater(r.distance[i], nearest - cell, f"point {i}")


if __name__ == "__main__":
    unittest.main()
