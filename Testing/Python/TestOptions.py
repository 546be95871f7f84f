# SPDX-License-Identifier: BSD-3-Clause
"""Options of invert(): each reaches the filter and does what it says; wrong ones are refused."""

import unittest

import numpy as np

import footpoint
from footpoint import Status
from footpoint._options import option_names
from shapes import bilinear, circle, parabola, random_points, sphere, square, torus

equal = np.testing.assert_array_equal
close = np.testing.assert_allclose
SWITCHES = {
    "parameters": "parameters",
    "distance": "distance",
    "signed_distance": "signed_distance",
    "closest_point": "closest_points",
    "normal": "normals",
    "tangent": "tangents",
    "face_id": "face",
    "status": "status",
    "foot_type": "foot_type",
    "isolated": "isolated",
    "iterations": "iterations",
}


def invert_sphere(**options):
    return footpoint.invert(random_points(60, 2), sphere(), **options)


class Enumerations(unittest.TestCase):
    def test_names_and_numbers(self):
        for option, names in (
            ("search", ["Global", "Seeded", "Local"]),
            ("method", ["Newton", "GaussNewton", "LevenbergMarquardt", "SecondOrder"]),
        ):
            for number, name in enumerate(names):
                expected = invert_sphere(**{option: number})
                for same in (name, name.upper(), name.lower(), np.int64(number)):
                    equal(invert_sphere(**{option: same}).parameters, expected.parameters, same)
        # The certified search has a step of its own; the others take the method's.
        seeded = {
            name: invert_sphere(search="Seeded", method=name).iterations
            for name in ("Newton", "GaussNewton", "gauss_newton")
        }
        equal(seeded["gauss_newton"], seeded["GaussNewton"])
        self.assertFalse(np.array_equal(seeded["Newton"], seeded["GaussNewton"]))

    def test_methods_of_curves(self):
        points = random_points(60)
        expected = footpoint.invert(points, parabola(), search="Seeded")
        for name in ("FirstOrder", "CurvatureCircle", "SecondOrder1", "SecondOrder2",
                     "SecondOrder3", "SecondOrder"):
            r = footpoint.invert(points, parabola(), method=name, search="Seeded")
            close(r.distance, expected.distance, atol=1e-9, err_msg=name)
            self.assertFalse(np.array_equal(r.iterations, expected.iterations), name)
            if name not in ("SecondOrder",):
                with self.assertRaisesRegex(ValueError, "Method"):
                    footpoint.invert(points, sphere(), method=name)

    def test_unknown(self):
        with self.assertRaisesRegex(ValueError, "search = 'fast' is none of Global, Seeded, Local"):
            invert_sphere(search="fast")
        for number in (-1, 3):
            with self.assertRaisesRegex(ValueError, f"search = {number} is out of range"):
                invert_sphere(search=number)


class Numbers(unittest.TestCase):
    def test_tolerances(self):
        points = random_points(60, 2)
        exact = footpoint.invert(points, bilinear(), search="Seeded")
        loose = footpoint.invert(points, bilinear(), search="Seeded", cosine_tolerance=1e-2)
        self.assertLess(loose.iterations.sum(), exact.iterations.sum())
        close(loose.distance, exact.distance, rtol=1e-3)
        r = footpoint.invert(
            [[0.5, 0.5, 1e-4]], square(), search="Seeded", point_tolerance=1e-2)
        self.assertEqual(r.status[0], Status.CONVERGED)
        for name in (
            "point_tolerance", "cosine_tolerance", "step_tolerance", "certificate_tolerance"
        ):
            for bad in (-1.0, 2.0):
                with self.assertRaisesRegex(ValueError, f"{name} = {bad} is out of range"):
                    invert_sphere(**{name: bad})

    def test_certificate_tolerance(self):
        """With 0 nothing is proved; the feet are the same."""
        points = random_points(60, 2)
        for geometry in (bilinear(), torus(), parabola()):
            r = footpoint.invert(points, geometry)
            bare = footpoint.invert(points, geometry, certificate_tolerance=0)
            equal(r.status, Status.CERTIFIED)
            equal(bare.status, Status.CONVERGED)
            close(bare.closest_points, r.closest_points, atol=1e-12)
            close(bare.distance, r.distance, atol=1e-14)
            same = footpoint.invert(points, geometry, certificate_tolerance=1e-12)
            equal(same.status, Status.CERTIFIED)
        # What is not sought globally is not proved.
        for search in ("Seeded", "Local"):
            equal(invert_sphere(search=search, certificate_tolerance=1).status, Status.CONVERGED)

    def test_limits_of_the_iteration(self):
        r = invert_sphere(search="Local", maximum_iterations=2)
        self.assertLessEqual(r.iterations.max(), 2)
        self.assertIn(Status.NOT_CONVERGED, r.status)
        few = invert_sphere(trust_radius=0.01, search="Local").iterations.sum()
        self.assertGreater(few, invert_sphere(search="Local").iterations.sum())
        with self.assertRaisesRegex(ValueError, "maximum_iterations = 0 is out of range"):
            invert_sphere(maximum_iterations=0)
        with self.assertRaisesRegex(TypeError, "maximum_iterations = 2.5 is no int"):
            invert_sphere(maximum_iterations=2.5)

    def test_seeding(self):
        for options in ({"seed_resolution": 3}, {"number_of_seeds": 1}, {"seed_resolution": 20}):
            r = invert_sphere(search="Seeded", **options)
            close(r.distance, invert_sphere().distance, atol=1e-12)

    def test_column_scaling(self):
        """Where v runs 1e8 times slower than u a unit of parameter says nothing."""
        net = [[(-1, -1, 1), (-1, 1, -1)], [(1, -1, -1), (1, 1, 1)]]
        slow = footpoint.nurbs_surface(net, [-1, -1, 1, 1], [-1e8, -1e8, 1e8, 1e8])
        points = random_points(60, 2)
        scaled, plain = (
            footpoint.invert(points, slow, search="Local", column_scaling=scaling)
            for scaling in (True, False)
        )
        equal(scaled.status, Status.CONVERGED)
        self.assertIn(Status.NOT_CONVERGED, plain.status)
        self.assertGreater(plain.iterations.sum(), 2 * scaled.iterations.sum())

    def test_isocurve_fallback(self):
        """Weights from 1e-5 to 1e5 make valleys that a step in u and v together does not follow."""
        rng = np.random.default_rng(27)
        i, j = np.mgrid[0:4, 0:4]
        net = np.stack([i, j, rng.integers(-3, 4, (4, 4))], axis=-1).astype(float)
        weights = 10.0 ** rng.integers(-5, 6, (4, 4))
        knots = [0] * 4 + [1] * 4
        steep = footpoint.nurbs_surface(net, knots, knots, weights)
        points = rng.integers(-2, 6, (150, 3)).astype(float)
        seeds = rng.integers(1, 8, (150, 2)) / 8
        with_fallback, without = (
            footpoint.invert(
                points, steep, search="Local", seed_parameters=seeds, isocurve_fallback=fallback)
            for fallback in (True, False)
        )
        missed = [np.sum(r.status == Status.NOT_CONVERGED) for r in (with_fallback, without)]
        self.assertLess(missed[0], missed[1])
        self.assertGreater((without.iterations - with_fallback.iterations).max(), 50)

    def test_switches(self):
        for name in ("column_scaling", "isocurve_fallback"):
            with self.assertRaisesRegex(TypeError, f"{name} = 'no' is no bool"):
                invert_sphere(**{name: "no"})

    def test_maximum_distance(self):
        points = [[0, 0, 1.5], [0, 0, 5]]
        r = footpoint.invert(points, sphere(), maximum_distance=1)
        equal(r.status, [Status.CERTIFIED, Status.BEYOND_MAXIMUM_DISTANCE])
        self.assertTrue(np.isnan(r.distance[1]) and np.isnan(r.closest_points[1]).all())
        equal(r.face, [0, -1])
        for unlimited in (np.inf, 1e299):
            r = footpoint.invert(points, sphere(), maximum_distance=unlimited)
            equal(r.status, Status.CERTIFIED)
        with self.assertRaisesRegex(ValueError, "MaximumDistance"):
            invert_sphere(maximum_distance=np.nan)
        with self.assertRaisesRegex(TypeError, "maximum_distance = 'far' is no float"):
            invert_sphere(maximum_distance="far")


class Modes(unittest.TestCase):
    def test_orthogonal_only(self):
        r = footpoint.invert([[2, 0.5, 1], [0.5, 0.5, 1]], square(), orthogonal_only=True)
        equal(r.status, [Status.NO_ORTHOGONAL_FOOT, Status.CONVERGED])
        close(r.distance, [np.sqrt(2), 1])

    def test_all_feet(self):
        faces = [square(0), square(3)]
        r = footpoint.invert([[0.5, 0.5, 1], [0.5, 0.5, 2.5]], faces, all_feet=True)
        equal(r.all_feet.point, [0, 0, 1, 1])
        equal(r.all_feet.face, [0, 1, 1, 0])
        close(r.all_feet.distance, [1, 2, 0.5, 2.5])
        self.assertEqual(len(r.distance), 2)
        self.assertIn("4 feet", repr(r.all_feet))
        self.assertIsNone(footpoint.invert([[0.5, 0.5, 1]], faces).all_feet)

    def test_all_feet_where_the_minimum_is_flat(self):
        """Every foot is listed once: at poles, over seams, at minima that are flat to rounding."""
        for name, point, geometry, count in (
            ("pole", [0, 0, 2], sphere(), 1),
            ("seam", [2, 1e-12, 0], sphere(), 1),
            ("two seams", [4.5, 0, 0], torus(), 1),
            ("beside two seams", [4.5, 1e-9, 1e-9], torus(), 1),
            ("centre of a circle", [0, 0, 0], circle(), 1),
            ("quartic minimum", [0, 0.5, 0], parabola(), 1),
            ("two minima", [0, 1, 0], parabola(), 2),
            ("two minima of a saddle", [0, 0, 1.5], bilinear(), 2),
        ):
            r = footpoint.invert([point], geometry, all_feet=True)
            self.assertEqual(len(r.all_feet.point), count, f"{name}: {r.all_feet.parameters[:9]}")
            close(r.all_feet.distance[0], r.distance[0], rtol=1e-14, err_msg=name)
            close(r.all_feet.closest_points[0], r.closest_points[0], atol=1e-4, err_msg=name)

    def test_fixed_direction(self):
        r = footpoint.invert([[0.5, 0, 0], [2, 0, 0]], sphere(), fixed_direction=[0, 0, 2])
        height = np.sqrt(0.75)
        close(r.all_feet.closest_points, [[0.5, 0, -height], [0.5, 0, height]], atol=1e-9)
        close(r.all_feet.distance, height)
        equal(r.all_feet.point, [0, 0])
        equal(r.status, [Status.CONVERGED, Status.BEYOND_MAXIMUM_DISTANCE])
        for other in ("all_feet", "orthogonal_only"):
            with self.assertRaisesRegex(ValueError, "not go together with AllFeet or Orthogonal"):
                invert_sphere(fixed_direction=(0, 0, 1), **{other: True})
        with self.assertRaisesRegex(ValueError, "fixed_direction has 2 values; 3 are needed"):
            invert_sphere(fixed_direction=(0, 1))
        with self.assertRaisesRegex(TypeError, "fixed_direction = 1 is no sequence of numbers"):
            invert_sphere(fixed_direction=1)

    def test_warm_start(self):
        """Along the axis of a saddle through the tie of two minima, a local search keeps its side."""
        path = np.array([(0.5 - 0.05 * k, 0.5 - 0.05 * k, 1.5) for k in range(13)])
        cold = footpoint.invert(path, bilinear(), search="Local")
        self.assertLess(cold.parameters[12, 0], 0)
        warm = footpoint.invert(path, bilinear(), search="Local", warm_start=True)
        self.assertTrue((warm.parameters > 0).all())
        close(warm.parameters[10], np.sqrt(0.5), atol=1e-9)
        self.assertGreater(warm.distance[12], cold.distance[12] + 0.05)
        # The certified foot depends on no start.
        r = footpoint.invert(path, bilinear(), warm_start=True)
        equal(r.parameters, footpoint.invert(path, bilinear()).parameters)
        equal(r.status, Status.CERTIFIED)
        with self.assertRaisesRegex(ValueError, "WarmStart does not go together with AllFeet"):
            invert_sphere(warm_start=True, all_feet=True)
        with self.assertRaisesRegex(ValueError, "warm_start takes no seed_parameters"):
            invert_sphere(warm_start=True, seed_parameters=np.zeros((60, 2)))

    def test_flip_normals(self):
        r, flipped = invert_sphere(), invert_sphere(flip_normals=True)
        equal(flipped.normals, -r.normals)
        equal(flipped.signed_distance, -r.signed_distance)
        equal(flipped.distance, r.distance)

    def test_seeds(self):
        """Of two equally good feet of the parabola the seed decides in a local search."""
        for side in (-1.0, 1.0):
            for seeds in ([side], [[side]]):
                r = footpoint.invert([[0, 1, 0]], parabola(), search="Local", seed_parameters=seeds)
                close(r.parameters, [[side * np.sqrt(0.5)]])
        # Only the face of the seed is searched from it. The nearest arm is the right one; from the
        # seed on the left a face gives the left one.
        for face, found in ((0, 1), (1, 0)):
            r = footpoint.invert(
                [[0.01, 2, 0]], [parabola(), parabola()], search="Local",
                seed_parameters=[[-1.2]], seed_face_id=face,
            )
            self.assertGreater(r.parameters[0, 0], 1)
            self.assertEqual(r.face[0], found)
        r = footpoint.invert(
            [[0.01, 2, 0]], [parabola(), parabola()], search="Local", seed_parameters=[[-1.2]])
        self.assertLess(r.parameters[0, 0], -1)
        for search in ("Seeded", "Local"):
            automatic = invert_sphere(search=search, seed_parameters=np.full((60, 2), np.nan))
            equal(automatic.parameters, invert_sphere(search=search).parameters)
        automatic = invert_sphere(seed_parameters=np.full((60, 2), np.nan))
        equal(automatic.parameters, invert_sphere().parameters)
        with self.assertRaisesRegex(ValueError, r"seed_parameters has shape \(5, 2\); \(60, 2\)"):
            invert_sphere(seed_parameters=np.zeros((5, 2)))
        with self.assertRaisesRegex(ValueError, r"seed_face_id has shape \(3,\); \(60,\)"):
            invert_sphere(seed_parameters=np.zeros((60, 2)), seed_face_id=[0, 0, 0])
        with self.assertRaisesRegex(ValueError, "seed_face_id is no array of integers"):
            invert_sphere(seed_parameters=np.zeros((60, 2)), seed_face_id=0.5)
        with self.assertRaisesRegex(ValueError, "says nothing without seed_parameters"):
            invert_sphere(seed_face_id=0)


class Output(unittest.TestCase):
    def test_every_option_exists(self):
        names = option_names(footpoint.vtkPointInversionFilter)
        self.assertEqual({n[9:] for n in names if n.startswith("generate_")}, set(SWITCHES))
        present = footpoint.vtkPointInversionFilter()
        for option, name in names.items():
            value = getattr(present, "Get" + name)()
            equal(invert_sphere(**{option: value}).parameters, invert_sphere().parameters, option)

    def test_generate(self):
        points, model = random_points(10), [sphere(), circle()]
        everything = footpoint.invert(points, model)
        for option, field in SWITCHES.items():
            r = footpoint.invert(points, model, **{"generate_" + option: False})
            for other in SWITCHES.values():
                value = getattr(r, other)
                if other == field:
                    self.assertIsNone(value, option)
                else:
                    equal(value, getattr(everything, other), other)

    def test_prefix_and_segments(self):
        plain = invert_sphere(all_feet=True)
        r = invert_sphere(all_feet=True, array_name_prefix="My", foot_segments=True)
        equal(r.distance, plain.distance)
        equal(r.all_feet.parameters, plain.all_feet.parameters)
        equal(r.all_feet.point, plain.all_feet.point)
        self.assertEqual(r.statistics["mean"], plain.statistics["mean"])
        self.assertTrue(r.foot_points.GetPointData().HasArray("MyDistance"))
        self.assertEqual(r.foot_points.GetNumberOfLines(), len(r.all_feet.point))
        self.assertEqual(plain.foot_points.GetNumberOfVerts(), len(r.all_feet.point))

    def test_unknown_option(self):
        with self.assertRaisesRegex(TypeError, "no option 'max_distance'; near ones: maximum_dist"):
            invert_sphere(max_distance=1)
        with self.assertRaisesRegex(TypeError, "no option 'xyzzy'; options: all_feet, "):
            invert_sphere(xyzzy=1)
        with self.assertRaisesRegex(TypeError, "no option 'parametric_function'"):
            invert_sphere(parametric_function=None)


if __name__ == "__main__":
    unittest.main()
