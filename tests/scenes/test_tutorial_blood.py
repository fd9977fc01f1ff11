"""The tutorial about dense blood: what its commands print, and how viscous blood is."""

import unittest

from scene_case import polyhedron
from tutorial_case import follow

BOX = 16 * 16 * 14
HEMATOCRIT = 0.4


class Tutorial(unittest.TestCase):
    def test_follows_the_page(self):
        folder, results = follow("tutorial_blood", "blood", tolerance=0.03)
        self.assertGreater((folder / "aggregates.png").stat().st_size, 10000)
        fast, slow, sticky = (result.thermo for result in results[:3])
        cell = polyhedron("rbc_162")[1]
        for table in (fast, slow, sticky):
            self.assertLess(abs(table["v_volume"][-1] - HEMATOCRIT), 0.6 * cell / BOX)
            # above Einstein's viscosity of few cells far apart
            self.assertGreater(table["v_relative"][1:].min(), 1 + 2.5 * HEMATOCRIT)
        # below that of whole blood of 43 % at 124 and 12.5 /s (Wells and Merrill 1962), which has
        # more viscous cells that adhere
        self.assertLess(fast["v_relative"].max(), 5)
        self.assertLess(sticky["v_relative"].max(), 9)
        # blood thins, and adhesion thickens it and makes larger aggregates
        later = [table["v_relative"][2:].mean() for table in (fast, slow, sticky)]
        self.assertEqual(later, sorted(later))
        self.assertGreater(sticky["c_clump[4]"][-1], slow["c_clump[4]"][-1])
        self.assertLess(sticky["c_clump[1]"][-1], slow["c_clump[1]"][-1])


if __name__ == "__main__":
    unittest.main()
