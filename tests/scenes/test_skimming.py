"""A vessel that parts into two: the account of cells that come into its daughters, and Pries' law
as study.py has it."""

import unittest

import numpy as np

from lammps_case import ROOT
from scene_case import polyhedron, run_example, study_of

SHARES = np.linspace(0, 1, 201)


class Law(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.study = study_of("skimming")
        cls.laws = cls.study.pries_1989, cls.study.pries_2005

    def test_equal_daughters(self):
        for law in self.laws:
            with self.subTest(law.__name__):
                self.assertAlmostEqual(float(law(0.5, 0.45, 20, 16, 16)), 0.5, delta=1e-12)
                # the Zweifach-Fung effect: cells prefer the daughter with more blood
                more = SHARES[(SHARES > 0.5) & (SHARES < 1)]
                self.assertTrue((law(more, 0.45, 20, 16, 16) > more).all())

    def test_what_one_daughter_gets_the_other_does_not(self):
        for law in self.laws:
            with self.subTest(law.__name__):
                first, second = law(SHARES, 0.3, 18, 9, 14), law(1 - SHARES, 0.3, 18, 14, 9)
                np.testing.assert_allclose(first + second, 1, atol=1e-12)

    def test_plasma_alone_below_a_least_share(self):
        # printed with the formulas: 0.4 um over the diameter, later 0.964 um times 1 - H over it
        for law, least in zip(self.laws, (0.4 / 12, 0.964 * 0.55 / 12)):
            with self.subTest(law.__name__):
                below, above = law(np.array([0.999, 1.001]) * least, 0.45, 12, 8, 10)
                self.assertEqual(below, 0)
                self.assertGreater(above, 0)
                self.assertEqual(law(1 - 0.999 * least, 0.45, 12, 8, 10), 1)
                self.assertLess(law(1 - 1.1 * least, 0.45, 12, 8, 10), 1)

    def test_as_a_power_law(self):
        """logit FQE = A + B logit(...), without logarithms: odds of a cell are a power of those of
        the blood, times (other/own)^-(6.96/D)."""
        share, hematocrit, feed, own, other = 0.3, 0.45, 12.0, 6.0, 9.0
        odds = (share - 0.4 / feed) / (1 - share - 0.4 / feed)
        cells = (other / own)**(6.96 / feed) * odds**(1 + 6.98 * (1 - hematocrit) / feed)
        self.assertAlmostEqual(float(self.study.pries_1989(share, hematocrit, feed, own, other)),
                               cells / (1 + cells), delta=1e-12)
        # with D_own^2/D_other^2 = 4/9 the later A is 13.29 * (5/13) * (1 - H)/D
        least = 0.964 * 0.55 / 12
        odds = (share - least) / (1 - share - least)
        cells = np.exp(13.29 * 5 / 13 * 0.55 / 12) * odds**(1 + 6.98 * 0.55 / 12)
        self.assertAlmostEqual(float(self.study.pries_2005(share, hematocrit, feed, own, other)),
                               cells / (1 + cells), delta=1e-12)

    def test_wide_vessels_and_pure_cells_skim_nothing(self):
        for law in self.laws:
            np.testing.assert_allclose(law(SHARES, 0.45, 1e6, 8e5, 8e5), SHARES, atol=1e-4)
        np.testing.assert_allclose(self.study.pries_2005(SHARES, 1, 20, 8, 14), SHARES, atol=1e-12)


class Counting(unittest.TestCase):
    def test_of_made_up_cells(self):
        """Three of four cells go into the first daughter, in an order without chance."""
        study = study_of("skimming")
        steps = np.arange(0, 401)
        into = np.column_stack([steps * 3 // 4, steps - steps * 3 // 4])
        rows = dict(volume=steps * 500.0, into=into,
                    volumes=np.outer(steps, [350.0, 150.0]))
        row = study.skimmed(rows, 0)
        self.assertAlmostEqual(row["share"], 0.7)
        self.assertAlmostEqual(row["part"], 0.75)
        self.assertAlmostEqual(row["cells"], 400)
        self.assertAlmostEqual(row["error"] / np.sqrt(0.75 * 0.25 / 400), 1, delta=0.01)
        self.assertLess(row["between"], 1e-12)
        self.assertAlmostEqual(row["feed"], study.VOLUME / 500)
        self.assertAlmostEqual(0.7 * row["hematocrit1"] + 0.3 * row["hematocrit2"], row["feed"])

    def test_a_side_that_cells_prefer(self):
        """A share and its mirror image: what draws cells to one side drops out."""
        study, steps = study_of("skimming"), np.arange(0, 201)
        rows = [dict(volume=steps, into=np.outer(steps, into), volumes=np.outer(steps, flow))
                for into, flow in (([0.75, 0.25], [0.7, 0.3]), ([0.35, 0.65], [0.3, 0.7]))]
        row = study.both(*(study.skimmed(part, 0) for part in rows))
        self.assertAlmostEqual(row["share"], 0.7)
        self.assertAlmostEqual(row["part"], 0.7)
        self.assertAlmostEqual(row["cells"], 400)

    def test_all_into_one(self):
        study, steps = study_of("skimming"), np.arange(0, 81)
        row = study.skimmed(dict(volume=steps, into=np.outer(steps, [1, 0]),
                                 volumes=np.outer(steps, [9, 1])), 0)
        self.assertEqual(row["part"], 1)
        # a chance of 1 in 82 for the next cell, by Laplace's rule of succession
        self.assertAlmostEqual(row["error"], np.sqrt(81) / 82 / np.sqrt(82))

    def test_error_of_a_binomial_process(self):
        """Where each cell goes is drawn anew: blocks differ as counting says."""
        study, draw = study_of("skimming"), np.random.default_rng(1)
        errors = []
        for _ in range(200):
            first = np.concatenate([[0], np.cumsum(draw.random(300) < 0.8)])
            steps = np.arange(301)
            row = study.skimmed(dict(volume=steps, into=np.column_stack([first, steps - first]),
                                     volumes=np.outer(steps, [1, 1])), 0)
            errors.append(row["between"])
        self.assertAlmostEqual(np.sqrt(np.mean(np.square(errors))) / np.sqrt(0.16 / 300), 1,
                               delta=0.1)


class Scene(unittest.TestCase):
    def test_first_steps(self):
        study, share = study_of("skimming"), 0.8
        result = run_example("skimming", everywhere=1, dx=1.25, share=share, steps=40, every=1,
                             frames=1000, tables=study.HERE, scripts=ROOT / "scripts")
        rows = study.read(result.path("skimming.dat"))
        self.assertAlmostEqual(study.VOLUME / polyhedron("rbc_162")[1], 1, delta=1e-4)
        # nothing is lost by counting, in or out
        wanted = study.HEMATOCRIT * rows["volume"] / study.VOLUME
        np.testing.assert_allclose(rows["entered"] + rows["owed"], wanted, atol=1e-3)
        there = rows["inside"] - rows["entered"] + rows["left"]
        self.assertEqual(len(set(there)), 1)
        np.testing.assert_array_equal(rows["left"], rows["gone"].sum(axis=1))
        np.testing.assert_allclose(rows["volumes"], np.outer(rows["volume"], [share, 1 - share]),
                                   rtol=2e-5)    # six digits
        # that cells leave makes no jump in what has come into a daughter, as they were in it
        print(f"\nentered {rows['entered'][-1]:.0f}, left {rows['gone'][-1]}, into the daughters "
              f"{rows['into'][0]} to {rows['into'][-1]}")
        self.assertGreaterEqual(rows["entered"][-1], 5)
        self.assertGreaterEqual(rows["left"][-1], 1)
        moved = np.diff(rows["into"], axis=0)
        self.assertGreaterEqual(moved.min(), -0.01)    # cells turn
        self.assertLess(moved.max(), 0.5)
        result = study.skimmed(rows, rows["volume"][1])
        self.assertAlmostEqual(result["share"], share, delta=1e-6)
        self.assertAlmostEqual(result["first"], rows["into"][-1, 0] - rows["into"][1, 0])
        self.assertAlmostEqual(share * result["hematocrit1"] + (1 - share) * result["hematocrit2"],
                               result["feed"], delta=1e-6)


if __name__ == "__main__":
    unittest.main()
