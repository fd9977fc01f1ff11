"""The scene of the top folder's README runs as it is, and so does that without variables."""

import re
import unittest

from lammps_case import POTENTIALS, ROOT, run

PLAIN = ROOT / "examples" / "suspension-shear" / "in.plain"
README = (ROOT / "README.md").read_text(encoding="utf-8").split("\n## A scene\n")[1]


def readme_scene():
    return README.split("```")[1]


class Scenes(unittest.TestCase):
    def test_of_the_readme(self):
        result = run(re.sub(r"\bpotentials/", f"{POTENTIALS}/", readme_scene()), 2, timeout=500)
        self.assertNotIn("WARNING", result.printed)
        table = result.thermo
        strain, viscosity = table["Time"] * 1e-4, table["v_relative"]
        print(f"\nviscosity over that of plasma {viscosity[strain > 5].mean():.3f}")
        self.assertGreater(strain[-1], 9)
        # as the text below the scene says
        cells, = re.findall(r"it makes (\d+) cells", README)
        self.assertIn(f"Created {cells} cells", result.printed)
        first, = re.findall(r"begins with ([\d.]+):", README)
        self.assertAlmostEqual(viscosity[0], float(first), places=2)
        mean, = re.findall(r"after 50000 µs, ([\d.]+):", README)
        self.assertAlmostEqual(viscosity[strain > 5].mean(), float(mean), delta=0.1)
        # cells dissipate more than they would far apart, Einstein's 1 + 2.5 phi, and less than
        # those of whole blood of 43 % at 124 /s, which adhere and have a more viscous inside: 5
        # (Wells and Merrill 1962)
        self.assertGreater(viscosity[strain > 1].min(), 1 + 2.5 * 0.4)
        self.assertLess(viscosity.max(), 5)

    def test_without_variables(self):
        script = PLAIN.read_text(encoding="utf-8").replace("../../potentials", str(POTENTIALS))
        script = script.replace("run             500", "run 50").replace("thermo          50",
                                                                         "thermo 10")
        result = run(script, 2, timeout=500)
        warned = re.findall(r"WARNING: (Fix rbc.*)", result.printed)    # as its README says
        self.assertTrue(len(warned) == 2 and all("dense.blood" in line for line in warned), warned)
        table = result.thermo
        relative = table["f_flow[1]"] / (1.5 * 1e-4)
        self.assertGreater(relative[1:].min(), 1)
        self.assertLess(relative.max(), 3)
        self.assertLess(table["f_flow[11]"].max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
