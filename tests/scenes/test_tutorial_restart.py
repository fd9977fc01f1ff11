"""The tutorial about restarts: runs that go on are those that were not stopped."""

import unittest

import numpy as np
from tutorial_case import follow


class Tutorial(unittest.TestCase):
    def test_follows_the_page(self):
        _, (whole, later, two) = follow("tutorial_restart", "blood", tolerance=0.02)
        tables = [result.thermo for result in (whole, later, two)]
        for name in ("v_relative", "f_mem"):
            rows = [dict(zip(table["Step"], table[name])) for table in tables]
            for step in (40, 50, 60):
                self.assertEqual(rows[1][step], rows[0][step])    # to the twelve digits printed
                np.testing.assert_allclose(rows[2][step], rows[0][step], rtol=1e-9)


if __name__ == "__main__":
    unittest.main()
