"""What a scene does not use costs it nothing: no neighbor list, no time, no message."""
import re
import unittest

from lammps_case import SHEAR, run, scene

USED = ["Membrane", "Spread", "Solve", "Interpolate", "Exchange", "Total"]


def sections(result):
    table = result.printed.split("USER-RBC step cost:")[1].split("Fluid:")[0]
    return re.findall(r"^(\w+) +\|", table, re.MULTILINE)[1:]


def traffic(result):
    return tuple(
        map(float, re.search(r"Fluid: (\S+) messages and (\S+) bytes", result.printed).groups()))


class OneCell(unittest.TestCase):
    """Without contact and walls."""

    def test_no_neighbor_list_and_no_row_of_cost(self):
        alone = run(scene(SHEAR, run="run 10"))
        self.assertNotIn("Neighbor list info", alone.printed)
        self.assertIn("Total # of neighbors = 0", alone.printed)
        self.assertEqual(sections(alone), USED)
        with_contact = run(scene(SHEAR, before="pair_style rbc/jkr 0.6\n"
                                               "pair_coeff 1 1 repulsive 0.007 0.4", run="run 10"))
        self.assertEqual(sections(with_contact),
                         ["Membrane", "Detection", "Contact", "Crossings", *USED[1:-1], "Gaps",
                          "Total"])

    def test_memory_is_what_lammps_says(self):
        for ranks in (1, 2):
            result = run(
                scene(SHEAR, before="pair_style rbc/jkr 0.6\npair_coeff 1 1 repulsive 0.007 0.4",
                      run="run 5\nrun 0"), ranks)
            rows = re.findall(r"^([A-Za-z]\S*(?: \S+)*) +\| +(\S+) \| +(\S+)$",
                              result.printed.split("Memory   ")[-1], re.MULTILINE)
            each = {name: float(number) for name, number, _ in rows}
            total = each.pop("Total")
            self.assertLessEqual({"Atoms", "pair rbc/jkr", "fix mem", "fix flow", "fix ib"},
                                 set(each))
            # rows below a byte are not there
            self.assertAlmostEqual(sum(each.values()) / total, 1, delta=5e-3)
            said = float(re.findall(r"memory allocation .* = \S+ \| (\S+) \|",
                                    result.printed)[-1]) * ranks * 2**20
            self.assertAlmostEqual(total * 162 / said, 1, delta=5e-3)

    def test_layers_for_sheets_only(self):
        """Messages are the same; sheets exchange two layers of ghost cells more, points do not."""
        points, sheets = (
            traffic(run(scene(SHEAR, ib=SHEAR["ib"] + f" sheets {word}", run="run 10"), ranks=2))
            for word in ("no", "yes"))
        self.assertEqual(points[0], sheets[0])
        self.assertLess(points[1], sheets[1])


if __name__ == "__main__":
    unittest.main()
