"""The tutorial about adhesion: the work asked for, and a contact that grows with it."""

import unittest

from tutorial_case import follow

REST = 1e-3        # of the elastic energy that may still be in motion


class Tutorial(unittest.TestCase):
    def test_follows_the_page(self):
        folder, results = follow("tutorial_adhesion", "doublet", tolerance=0.02)
        self.assertGreater((folder / "strong.png").stat().st_size, 10000)
        medium, gaps, weak, strong = results
        self.assertRegex(gaps.printed, r"cells\.5000\.vtp 1 0 0\.")    # one pair, none cut
        areas = []
        for sigma, result in ((5.0e-5, weak), (5.0e-4, medium), (2.0e-3, strong)):
            table = result.thermo
            areas.append(table["v_area"][-1])
            # no part of a contact has more than the work of adhesion; its edge has less
            self.assertLess(table["v_work"][-1], sigma)
            self.assertGreater(table["v_work"][-1], 0.75 * sigma)
            self.assertLess(table["KinEng"][-1], REST * table["f_mem"][-1])
            self.assertLess(table["v_share"][-1], 50)    # only one side can touch
        self.assertEqual(areas, sorted(areas))
        self.assertIn("work per area 0.0005", medium.printed)


if __name__ == "__main__":
    unittest.main()
