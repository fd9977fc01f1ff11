"""The tutorial about a shape of one's own: through an STL file to a cell that tumbles."""

import unittest

import numpy as np
from lammps_case import read_template
from tutorial_case import follow


class Tutorial(unittest.TestCase):
    def test_follows_the_page(self):
        folder, results = follow("tutorial_shape", "shear-cell", tolerance=0.02)
        self.assertGreater((folder / "sickle.png").stat().st_size, 5000)
        x, triangles = read_template(folder / "sickle.mol")
        corners = x[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        area, volume = np.linalg.norm(normals, axis=1).sum(), np.sum(corners[:, 0] * normals) / 3
        self.assertAlmostEqual(volume, 90, delta=1e-3)
        table = results[2].thermo
        self.assertAlmostEqual(table["v_area"][0], area, delta=1e-2)
        np.testing.assert_allclose(table["v_volume"], volume, rtol=2e-4)
        np.testing.assert_allclose(table["v_area"], area, rtol=2e-3)
        # the flow turns it as it turns all things, slowest where it lies along the flow
        turned = np.unwrap(table["v_angle"], period=180)
        self.assertTrue(np.all(np.diff(turned) < 0))
        self.assertLess(turned[-1], -150)
        self.assertLess(np.diff(turned).min(), 5 * np.diff(turned)[:3].mean())


if __name__ == "__main__":
    unittest.main()
