"""The table of a scene at the start of a run: its numbers against those of the template and the
flow, and which of them are warned of."""

import re
import unittest

import numpy as np

from lammps_case import POTENTIALS, SHEAR, in_parallel, read_template, run, scene, version
from test_ports import TUBE
from test_stream import CONTACT as CONTACT_OF_STREAM
from test_stream import EMPTY, MEMBRANE, stream

PLATES = SHEAR["fluid"].replace("dx 1.0", "dx 1.2")
TWO = {"box": "region box block 0 24 0 12 0 12",
       "cells": "rbc/create rbc single 6 6 6\nrbc/create rbc single 18 6 6"}
CONTACT = "pair_style rbc/jkr {0}\npair_coeff * * repulsive 0.5 {0}"
WITHOUT_CELLS = {"molecule": None, "cells": "create_atoms 1 single 6 6 6\nmass 1 1",
                 "membrane": None, "compute": None, "thermo": "thermo_style custom step f_flow[11]"}
REPELLED = "fix plates all wall/harmonic zlo EDGE 0.02 1.0 0.5 zhi EDGE 0.02 1.0 0.5"


def warnings(result):
    return re.findall(r"WARNING: (Fix rbc/fluid flow: .*) \(", result.printed)


def rows(result):
    """The numbers of each kind of cell, by the ID of its fix."""
    table = re.search(r"^USER-RBC scene: .*\n.*\n.*in fluid spacings\n((?:.*\|.*\n)+)",
                      result.printed, re.MULTILINE)
    found = {}
    for line in table.group(1).splitlines():
        name, *numbers = line.replace("|", " ").split()
        found[name] = [float(word) if word not in ("none", "-") else 0 for word in numbers]
    return found


def edges_and_volume(name):
    x, triangles = read_template(POTENTIALS / name)
    corners = x[triangles]
    lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)    # each edge twice
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    return lengths.mean(), lengths.max(), volume


class Numbers(unittest.TestCase):
    def test_of_a_cell_in_shear(self):
        result = run(scene(fluid=PLATES, neighbor="neighbor 1.2 bin"))
        number, mean, longest, _, contact, capillary = rows(result)["mem"]
        expected_mean, expected_longest, volume = edges_and_volume("rbc_162.mol")
        self.assertEqual(number, 1)
        self.assertEqual(contact, 0)
        np.testing.assert_allclose([mean, longest], [expected_mean / 1.2, expected_longest / 1.2],
                                   rtol=5e-3)
        radius = (0.75 / np.pi * volume)**(1 / 3)
        np.testing.assert_allclose(
            capillary, 1.5 * 0.0012 / 12 * radius / (2 * (0.257 + 0.0257) * 0.01), rtol=5e-3)
        # half a skin, a cell in a step, kernel, differences of sheets
        self.assertRegex(result.printed,
                         r"scene: 10 x 10 x 10 fluid cells, spacing 1.2, neighbor skin 1 spacings, "
                         rf"{int(np.ceil(0.5 + 1)) + 2 + 2} ghost layers")
        self.assertIn("Plates: shear rate 0.0001 (100 /s); no fix wall repels cells from them",
                      result.printed)
        self.assertEqual(warnings(result), [])

    def test_in_other_units(self):
        """In units real forces are not masses times accelerations."""
        fluid = (PLATES.replace("dx 1.2", "dx 1.2e4").replace("viscosity 1.5", "viscosity 9.033e-4")
                 .replace("density 1.025", "density 6.17e-13").replace("0.0012", "1.2e-8"))
        result = run(scene(units="units real", box="region box block 0 12e4 0 12e4 0 12e4",
                           molecule=f"molecule rbc {POTENTIALS}/rbc_162.mol scale 1e4",
                           cells="rbc/create rbc single 6e4 6e4 6e4", neighbor="neighbor 1e4 bin",
                           fluid=fluid,
                           membrane="fix mem all rbc/membrane rbc skalak 1e-9 1 bending 1e-4",
                           timestep="timestep 1e-3"))
        _, _, volume = edges_and_volume("rbc_162.mol")
        radius = 1e4 * (0.75 / np.pi * volume)**(1 / 3)
        stress = 9.033e-4 * 1.2e-8 / 12e4 / 4.184e-4    # g/mol A/fs^2 in kcal/mol/A
        np.testing.assert_allclose(rows(result)["mem"][5], stress * radius / 1e-9, rtol=5e-3)

    def test_thickness_of_a_capsule_is_its_diameter(self):
        result = run(scene(molecule=f"molecule rbc {POTENTIALS}/capsule_642.mol scale 3"))
        self.assertGreater(rows(result)["mem"][3], 5.9)
        self.assertLessEqual(rows(result)["mem"][3], 6)

    def test_contact_range(self):
        # the range of repulsive tips is their radius; of other pair styles between vertices their
        # cutoff
        contacts = (CONTACT.format(1.3), "pair_style lj/cut 0.9\npair_coeff * * 0 0.5")
        results = in_parallel(lambda contact: run(scene(**TWO, before=contact, last=REPELLED)),
                              [(contact,) for contact in contacts])
        self.assertEqual([rows(result)["mem"][4] for result in results], [1.3, 0.9])
        self.assertEqual(warnings(results[0]), [])
        self.assertIn("cells are repelled by wall/harmonic plates", results[0].printed)

    def test_what_repels_cells(self):
        region = "region middle block INF INF INF INF 1 11 units box\n"
        styles = {"plates yes": "pair rbc/jkr plates", "walls middle": "pair rbc/jkr walls middle",
                  "plates yes walls middle": "pair rbc/jkr plates, walls middle", "plates no": ""}
        results = in_parallel(
            lambda words: run(scene(
                **TWO, before=region + CONTACT.format(1.3).replace("1.3\n", f"1.3 {words}\n"))),
            [(words,) for words in styles])
        for repelling, result in zip(styles.values(), results):
            with self.subTest(repelling):
                if repelling:
                    self.assertIn(f"; cells are repelled by {repelling}\n", result.printed)
                    self.assertEqual(warnings(result), [])
                else:
                    self.assertIn("no fix wall repels cells from them", result.printed)
                    self.assertRegex(warnings(result)[0],
                                     "nothing repels the 2 cells from the plates; use plates yes")

    def test_what_repels_cells_that_are_still_to_come(self):
        """In a vessel without cells, which fix rbc/stream is about to fill."""
        held = "group others empty\nfix off {} wall/region tube harmonic 0.1 1 0.5"
        cases = {"pair rbc/jkr walls tube": CONTACT_OF_STREAM,
                 "wall/region off": held.format("cells"), "": held.format("others")}
        results = in_parallel(
            lambda contact: run(stream(**EMPTY, run="run 0",
                                       wall=f"{TUBE['wall']}\n{MEMBRANE}\n{contact}")),
            [(contact,) for contact in cases.values()])
        for name, result in zip(cases, results):
            self.assertEqual(rows(result)["mem"][0], 0)
            self.assertIn(f"; cells are repelled by {name}\n" if name else
                          "; no fix wall repels cells from them\n", result.printed)

    def test_fastest_wall(self):
        ball = "region ball sphere 2 2 2 1.5\nrbc/surface ball type 2 spacing 0.9 mass 1\n" \
               "group ball type 2\ngroup cells type 1"
        result = run(scene(boundary=None, create_box="create_box 2 box angle/types 1",
                           cells=SHEAR["cells"] + "\n" + ball,
                           membrane=SHEAR["membrane"].replace("all", "cells"),
                           fluid=SHEAR["fluid"].split(" wall")[0] +
                           "\nfix ball ball rbc/wall flow velocity 3e-4 0 4e-4",
                           ib=SHEAR["ib"].replace("all", "cells")))
        _, _, volume = edges_and_volume("rbc_162.mol")
        radius = (0.75 / np.pi * volume)**(1 / 3)
        np.testing.assert_allclose(rows(result)["mem"][5], 1.5 * 5e-4 / 6 * radius / 0.005654,
                                   rtol=5e-3)
        self.assertIn("Walls: fix rbc/wall ball; no fix wall repels cells from them",
                      result.printed)

    def test_timestep_times_spectral_radius(self):
        result = run(scene(ib="fix ib all rbc/ib flow integrator rkc auto",
                           thermo="thermo_style custom step f_ib[6] f_ib[9]", run="run 4"))
        product = float(re.search(r"^Timestep times spectral radius: (.*)$", result.printed,
                                  re.MULTILINE).group(1))
        np.testing.assert_allclose(
            product, result.thermo["f_ib[6]"][-1] * result.thermo["f_ib[9]"][-1], rtol=1e-3)


class Warnings(unittest.TestCase):
    def test_what_is_out_of_range(self):
        other = SHEAR["membrane"].replace("fix mem all", "fix stiff two").replace("0.257 0.0257",
                                                                                  "2.57 0.257")
        mean = edges_and_volume("rbc_162.mol")[0]
        cases = {
            "no contact": (dict(TWO),
                           ["nothing keeps the 2 cells of fix rbc/membrane mem from passing",
                            "nothing repels the 2 cells from the plates"]),
            "not of both kinds": (
                dict(TWO, create_box="create_box 2 box angle/types 1",
                     before="mass 2 1\nset mol 2 type 2\n"
                     "group one type 1\ngroup two type 2\npair_style rbc/jkr 1.2\n"
                            "pair_coeff 1 1 repulsive 0.5 1.2\n"
                     "pair_coeff 2 2 repulsive 0.5 1.2\npair_coeff 1 2 none",
                     membrane=SHEAR["membrane"].replace("all", "one") + "\n" + other,
                     last=REPELLED),
                ["nothing keeps the 1 cells of fix rbc/membrane mem and the 1 of fix rbc/membrane "
                 "stiff from passing"]),
            "short contact": (dict(TWO, before=CONTACT.format(0.5), last=REPELLED),
                              ["repel each other from 0.5 fluid spacings on; below 1 the fluid "
                               "between them is not resolved: increase R of pair_coeff (variable "
                               "range before dense.blood), or use a smaller dx"]),
            "thin": (dict(membrane=SHEAR["membrane"] + " interior 15"),
                     ["fluid spacings thick, and below 2 an inside that is 10 times as viscous as "
                      "the fluid is not resolved: use dx 0.4"]),
            "not too thin": (dict(membrane=SHEAR["membrane"] + " interior 7.5"), []),
            "long edges": (dict(fluid=PLATES.replace("dx 1.2", "dx 0.4"),
                                neighbor="neighbor 0.4 bin", timestep="timestep 20"),
                           [f"mem are {mean / 0.4:.3g} fluid spacings long on average, and 0.5 to "
                            "1.7 are resolved: use a larger dx or a template with more vertices"]),
            "short edges": (dict(fluid=PLATES.replace("dx 1.2", "dx 3")),
                            [f"mem are {mean / 3:.3g} fluid spacings long on average, and 0.5 to "
                             "1.7 are resolved: "
                             "use a smaller dx or a template with fewer vertices"])}
        results = in_parallel(lambda name: run(scene(**cases[name][0])),
                              [(name,) for name in cases])
        for name, result in zip(cases, results):
            with self.subTest(name):
                found = warnings(result)
                self.assertEqual(len(found), len(cases[name][1]), found)
                for warning in found:
                    self.assertTrue(any(words in warning for words in cases[name][1]), warning)

    def test_what_looks_like_other_units(self):
        """Just above and below a capillary number of 10 and an adhesion of 5 shear moduli."""
        _, _, volume = edges_and_volume("rbc_162.mol")
        radius, modulus = (0.75 / np.pi * volume)**(1 / 3), 0.005654
        rates = {number: number * modulus / (1.5 * radius) for number in (9.9, 10.1)}
        sheared = {number: dict(fluid=PLATES.replace("0.0012", repr(12 * rate)), run="run 0",
                                timestep="timestep 1e-6")
                   for number, rate in rates.items()}
        adhered = {times: dict(TWO, run="run 0", last=REPELLED, before="pair_style rbc/jkr 3\n"
                               f"pair_coeff * * adhesive {200 * times * modulus!r} "
                               f"{times * modulus!r} 1.3")
                   for times in (4.9, 5.1)}
        cases = {**sheared, **adhered}
        results = in_parallel(lambda name: run(scene(**cases[name])), [(name,) for name in cases])
        found = {name: warnings(result) for name, result in zip(cases, results)}
        self.assertEqual([len(found[name]) for name in cases], [0, 1, 0, 1], found)
        self.assertIn("the capillary number of the cells of fix rbc/membrane mem is 10.1, and "
                      "above 10 they are drawn to several times their length: check the units of "
                      f"the shear rate {rates[10.1]:.3g} (in units micro it is per us: 50 /s is "
                      "50e-6)", found[10.1][0])
        self.assertIn(f"the adhesion {5.1 * modulus:.3g} of the cells of fix rbc/membrane mem is "
                      "5.1 times their shear modulus, and above 5 it tears at their membranes: "
                      "check its units (in units micro it is in mJ/m^2: 0.2 uJ/m^2 is 2e-4)",
                      found[5.1][0])

    def test_what_no_liquid_and_no_membrane_has(self):
        """Just above and below 1e-4 Pa s and 1e-21 J, in several units; a modulus of 0 is none."""
        micro = "units micro"
        cases = {  # units, viscosity, bending: warnings
            (micro, "0.11", "1.1e-6"): [], (micro, "0.09", "1.1e-6"): ["viscosity"],
            (micro, "0.11", "0.9e-6"): ["bending"], (micro, "0.11", "0"): [],
            ("units si", "1.1e-4", "1.1e-21"): [], ("units si", "0.9e-4", "0.9e-21"):
            ["viscosity", "bending"], ("units cgs", "1.1e-3", "1.1e-14"): [],
            ("units cgs", "0.9e-3", "0.9e-14"): ["viscosity", "bending"],
            ("units nano", "0.11", "1.1"): [], ("units nano", "0.09", "0.9"):
            ["viscosity", "bending"], ("units lj", "1e-9", "1e-30"): []}

        def found(units, viscosity, bending):
            result = run(scene(
                units=units, fluid=PLATES.replace("viscosity 1.5", f"viscosity {viscosity}"),
                membrane=f"fix mem all rbc/membrane rbc skalak 1.0 1 bending {bending}",
                neighbor="neighbor 1.0 bin", timestep="timestep 1e-9"))
            return warnings(result)

        results = in_parallel(found, list(cases))
        for case, result in zip(cases, results):
            with self.subTest(case):
                self.assertEqual(len(result), len(cases[case]), result)
                for warning, words in zip(result, cases[case]):
                    self.assertIn(words, warning)
        viscosity = results[list(cases).index((micro, "0.09", "1.1e-6"))][0]
        self.assertIn("the viscosity of the fluid is 9e-05 Pa s", viscosity)
        bending = results[list(cases).index((micro, "0.11", "0.9e-6"))][0]
        self.assertIn("the bending modulus of the cells of fix rbc/membrane mem is 9e-22 J",
                      bending)

    def test_cells_that_begin_at_a_plate(self):
        lowest = -read_template(POTENTIALS / "rbc_162.mol")[0][:, 2].min()
        apart = {"lower": (lowest + 0.12, 6), "upper": (6, 12 - lowest - 0.13),
                 "far": (lowest + 0.21, 6)}
        for ranks in (1, 2):
            for name, (one, other) in apart.items():
                cells = f"rbc/create rbc single 6 6 {one}\nrbc/create rbc single 18 6 {other}"
                result = run(scene(**dict(TWO, cells=cells), before=CONTACT.format(1.3),
                                   last=REPELLED), ranks)
                expected = {"lower": ["0.12"], "upper": ["0.13"], "far": []}[name]
                found = [re.search(r"a cell is (\S+) fluid spacings from a plate; nearer than 0.2 ",
                                   warning)
                         for warning in warnings(result)]
                self.assertEqual([match.group(1) for match in found], expected)

    def test_are_turned_off_and_printed_once(self):
        quiet = run(scene(**TWO, last="fix_modify flow warn no"))
        self.assertEqual(warnings(quiet), [])
        self.assertEqual(quiet.printed.count("USER-RBC scene"), 1)
        again = run(scene(**TWO, run="run 0\nrun 0\nneighbor 0.8 bin\nrun 0"), ranks=2)
        self.assertEqual(again.printed.count("USER-RBC scene"), 2)    # the skin changed
        self.assertEqual(again.printed.count("nothing repels the 2 cells"), 2)

    def test_version_of_the_package_stands_above_once(self):
        """Also where a second table follows, and in scenes without cells. CMakeLists.txt has it."""
        again = run(scene(**TWO, run="run 0\nrun 0\nneighbor 0.8 bin\nrun 0"), ranks=2)
        lines = again.printed.splitlines()
        named = [n for n, line in enumerate(lines) if line.startswith("USER-RBC version")]
        self.assertEqual([lines[n] for n in named], [f"USER-RBC version {version()}"])
        self.assertLess(named[0],
                        next(n for n, line in enumerate(lines) if "USER-RBC scene" in line))
        self.assertIn(f"USER-RBC version {version()}\n", run(scene(**WITHOUT_CELLS)).printed)

    def test_nothing_without_cells(self):
        self.assertNotIn("USER-RBC scene", run(scene(**WITHOUT_CELLS)).printed)


if __name__ == "__main__":
    unittest.main()
