"""Orders, limits and errors of values that are made up, of which all are known."""
import unittest

import numpy as np

import richardson

SIZES = np.array([1.0, 0.5, 0.25])


def made(sizes, order, limit=3.0, factor=0.7):
    return limit + factor * np.asarray(sizes)**order


class Exact(unittest.TestCase):
    def test_order_and_limit(self):
        for order in (0.6, 1.0, 1.5, 2.0):
            for sizes in (SIZES, [0.8, 0.65, 0.5]):
                found = richardson.fit(sizes, made(sizes, order))
                self.assertLess(abs(found.order - order), 1e-5)
                self.assertLess(abs(found.limit[0] - 3), 1e-5)
                error = 0.7 * np.asarray(sizes)**order
                np.testing.assert_allclose(found.offsets, error, atol=1e-4)
                np.testing.assert_allclose(found.bounds, 1.25 * error + self.more(sizes, order),
                                           atol=2e-4)

    @staticmethod
    def more(sizes, order):
        """That the finest value is further from the limit of h and h^2 than from that of h^p."""
        h = np.sort(sizes)[:3]
        if len(sizes) > 3 or order in (1.0, 2.0):
            return 0.0
        of_both = np.linalg.solve(h[:, None]**np.arange(3), made(h, order))[0]
        return 1.25 * max(0.0, abs(made(h[0], order) - of_both) - 0.7 * h[0]**order)

    def test_any_order_of_the_settings(self):
        shuffled = [0.25, 1.0, 0.5]
        found = richardson.fit(shuffled, made(shuffled, 1.5))
        np.testing.assert_allclose(found.offsets, 0.7 * np.array(shuffled)**1.5, rtol=1e-4)

    def test_many_settings(self):
        sizes = [0.9, 0.7, 0.4, 0.3, 0.1]
        found = richardson.fit(sizes, made(sizes, 1.5) + 1e-3 * np.array([1, -1, 1, -1, 1]))
        self.assertLess(abs(found.order - 1.5), 0.1)
        self.assertLess(abs(found.limit[0] - 3), 5e-3)
        self.assertTrue((found.bounds > made(sizes, 1.5) - 3).all())

    def test_series_share_an_order(self):
        time = np.linspace(0, 6, 50)
        values = np.sin(time) + np.multiply.outer(SIZES**1.3, np.cos(3 * time))
        found = richardson.fit(SIZES, values)
        self.assertAlmostEqual(found.order, 1.3, places=4)
        np.testing.assert_allclose(found.limit, np.sin(time), atol=1e-4)
        error = SIZES**1.3 * np.sqrt(np.mean(np.cos(3 * time)**2))
        np.testing.assert_allclose(found.offsets, error, rtol=1e-3)

    def test_two_of_a_known_order(self):
        self.assertAlmostEqual(
            richardson.extrapolate(0.5, made(0.5, 2), 0.8, made(0.8, 2), 2), 3)
        found = richardson.fit([0.8, 0.5], made([0.8, 0.5], 2), order=2)
        self.assertAlmostEqual(found.limit[0], 3)
        self.assertTrue(np.isnan(found.observed))
        np.testing.assert_allclose(found.bounds, 3 * 0.7 * np.array([0.64, 0.25]))   # Roache, 1994


class Careful(unittest.TestCase):
    """Where no order is to be had, none is given, and the error is covered all the same."""

    def test_two_without_an_order(self):
        found = richardson.fit([0.8, 0.5], made([0.8, 0.5], 1))
        self.assertTrue(np.isnan(found.order))
        self.assertIn("two settings", found.why)
        np.testing.assert_allclose(found.bounds[1], 3 * 0.7 * 0.5)

    def test_up_and_down(self):
        found = richardson.fit(SIZES, [1.0, 1.2, 1.1])
        self.assertTrue(np.isnan(found.order) and np.isnan(found.observed))
        self.assertIn("up and down", found.why)
        rest = 1.25 * (1.1 - np.polyfit(SIZES, [1.0, 1.2, 1.1], 2)[-1])     # more than 3 0.2 / 3
        np.testing.assert_allclose(found.bounds, rest + np.array([0.1, 0.1, 0.0]))
        closer = richardson.fit(SIZES, [1.0, 1.2, 1.19])
        self.assertAlmostEqual(closer.bounds[2], 3 * 0.2 / 3)

    def test_differences_that_grow(self):
        found = richardson.fit(SIZES, [1.0, 1.1, 1.4])
        self.assertTrue(np.isnan(found.order))
        self.assertIn("do not shrink", found.why)

    def test_slow(self):
        values = made(SIZES, 0.2)
        found = richardson.fit(SIZES, values)
        self.assertTrue(np.isnan(found.order))
        self.assertAlmostEqual(found.observed, 0.2, places=4)
        self.assertTrue((found.bounds > values - 3).all())

    def test_faster_than_the_order_that_is_trusted(self):
        found = richardson.fit(SIZES, made(SIZES, 3))
        self.assertAlmostEqual(found.observed, 3, places=4)
        self.assertEqual(found.order, 2)
        self.assertTrue((found.bounds > 0.7 * SIZES**3).all())
        self.assertGreater(richardson.fit(SIZES, [1.5, 1.0, 1.0]).bounds[2], 0.03)

    def test_errors_of_two_orders(self):
        """Those of first and second order are covered whatever their signs; most of others."""
        for sizes in (SIZES, np.array([0.8, 0.65, 0.5]), np.array([1.0, 0.8, 0.6, 0.4])):
            for orders, least in (((1, 2), 1.0), ((2, 4), 1.0), ((1, 3), 0.7), ((0.5, 1), 0.7)):
                covered = []
                for share in np.linspace(-4, 2, 31):
                    error = 0.1 * sizes**orders[0] + 0.1 * share * sizes**orders[1]
                    covered.append(richardson.fit(sizes, 3 + error).bounds >= abs(error) - 1e-12)
                self.assertGreaterEqual(np.mean(covered, axis=0).min(), least, (sizes, orders))

    def test_an_order_other_than_the_known_one(self):
        self.assertEqual(richardson.fit(SIZES, made(SIZES, 1), order=2).order,
                         richardson.fit(SIZES, made(SIZES, 1)).order)
        np.testing.assert_allclose(richardson.fit(SIZES, made(SIZES, 1), order=2).bounds,
                                   3 * 0.7 * SIZES, rtol=1e-3)

    def test_the_same(self):
        found = richardson.fit(SIZES, [2.0, 2.0, 2.0])
        self.assertIn("the same", found.why)
        self.assertLess(found.bounds.max(), 1e-12)

    def test_nonsense(self):
        for sizes in ([1.0], [1.0, 1.0], [1.0, 0.0]):
            with self.assertRaises(ValueError):
                richardson.fit(sizes, np.ones(len(sizes)))


class Noise(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(5)

    def drawn(self, noise, order=1.0, count=100):
        """Fits of values with noise, and the values without it."""
        values = made(SIZES, order)
        return [richardson.fit(SIZES, values + noise * self.random.standard_normal(3),
                               np.full(3, noise)) for _ in range(count)], values

    def test_little(self):
        fits, values = self.drawn(0.005)
        known = [fit for fit in fits if not fit.why]
        self.assertGreater(len(known), 90)
        inside = np.mean([fit.between[0] <= 1.0 <= fit.between[1] for fit in known])
        self.assertTrue(0.5 < inside < 0.85, inside)
        covered = np.mean([fit.bounds >= values - 3 for fit in fits], axis=0)
        self.assertTrue((covered > 0.95).all(), covered)

    def test_orders_that_are_high_in_any_case(self):
        """How high does not matter, as 2 is used."""
        fits, values = self.drawn(0.01, order=3.5)
        self.assertGreater(np.mean([fit.order == 2 for fit in fits]), 0.9)
        self.assertGreater(np.mean([np.ptp(fit.between) > 1 for fit in fits]), 0.1)
        covered = np.mean([fit.bounds >= values - 3 for fit in fits], axis=0)
        self.assertTrue((covered > 0.95).all(), covered)

    def test_more_than_the_differences(self):
        fits, values = self.drawn(1.0)
        self.assertGreater(np.mean([fit.why == "it is within the noise" or "up and down" in fit.why
                                    for fit in fits]), 0.99)
        self.assertTrue(all(np.isnan(fit.order) for fit in fits if fit.why))
        covered = np.mean([fit.bounds >= values - 3 for fit in fits], axis=0)
        self.assertTrue((covered > 0.9).all(), covered)


if __name__ == "__main__":
    unittest.main()
