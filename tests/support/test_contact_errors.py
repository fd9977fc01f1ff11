"""What bad input to pair_style rbc/jkr gets."""

import re
import unittest

from error_case import BadInput, DuringARun
from lammps_case import SHEAR, attempt, scene

ADHESIVE = "pair_coeff 1 1 adhesive 0.0628 1e-3 0.3"


def contact(pair="pair_style rbc/jkr 0.5", coeff=ADHESIVE, **changes):
    return dict(before=f"{pair}\n{coeff}", **changes)


CONTACT_ERRORS = {
    "no cutoff": (contact("pair_style rbc/jkr"), ["pair_style rbc/jkr", "missing"]),
    "unknown keyword": (contact("pair_style rbc/jkr 0.5 own yes"),
                        ["pair_style rbc/jkr", "own", "allowed: self"]),
    "self without value": (contact("pair_style rbc/jkr 0.5 self"),
                           ["pair_style rbc/jkr self", "missing"]),
    "self neither yes nor no": (contact("pair_style rbc/jkr 0.5 self maybe"), ["maybe"]),
    "unknown units": (contact("pair_style rbc/jkr 0.5 units um"),
                      ["pair_style rbc/jkr", "units", "um", "box, dx"]),
    "units without value": (contact("pair_style rbc/jkr 0.5 units"),
                            ["pair_style rbc/jkr units", "missing"]),
    "units dx without a fluid": (contact("pair_style rbc/jkr 0.5 units dx", ib=None, fluid=None,
                                         thermo=None),
                                 ["pair rbc/jkr units dx", "no fix rbc/fluid", "units box"]),
    "cutoff below the range in spacings": (
        contact("pair_style rbc/jkr 0.19 units dx", "pair_coeff 1 1 repulsive 0.1 0.2",
                fluid=SHEAR["fluid"].replace("dx 1.0", "dx 2.0")),
        ["rbc/jkr", "cutoff", "0.19", "at least 0.2", "types 1 1"]),
    "plates neither yes nor no": (contact("pair_style rbc/jkr 0.5 plates both"), ["both"]),
    "plates without a fluid":
        (contact("pair_style rbc/jkr 0.5 plates yes", ib=None, fluid=None, thermo=None),
         ["pair rbc/jkr plates yes", "no fix rbc/fluid with plates", "plates no", "walls REGION in "
          "a vessel (before dense.blood: variable surfaces string \"walls REGION\")"]),
    "plates in a periodic box": (contact("pair_style rbc/jkr 0.5 plates yes",
                                         boundary="boundary p p p",
                                         fluid=SHEAR["fluid"].split(" wall")[0]),
                                 ["pair rbc/jkr plates yes", "no fix rbc/fluid with plates"]),
    "plates and no law": (contact("pair_style rbc/jkr 0.5 plates yes", "pair_coeff * * none"),
                          ["pair rbc/jkr plates", "no atom type has a law with itself"]),
    "walls without value": (contact("pair_style rbc/jkr 0.5 walls"),
                            ["pair_style rbc/jkr walls", "missing"]),
    "walls of no region": (contact("pair_style rbc/jkr 0.5 walls tube"),
                           ["pair rbc/jkr walls", "no region", "tube"]),
    "cutoff zero": (contact("pair_style rbc/jkr 0"), ["rbc/jkr", "cutoff", "0", "> 0"]),
    "cutoff infinite": (contact("pair_style rbc/jkr 1e999"),
                        ["rbc/jkr cutoff value '1e999' must be a finite number"]),
    "cutoff no number": (contact("pair_style rbc/jkr far"), ["'far'", "rbc/jkr"]),
    "cutoff below the range": (contact("pair_style rbc/jkr 0.38"),
                               ["rbc/jkr", "cutoff", "0.38", "at least 0.382576", "types 1 1"]),
    "no coefficients": (contact(coeff=""), ["coeffs", "not set"]),
    "coefficients missing": (contact(coeff="pair_coeff 1 1"), ["pair_coeff", "rbc/jkr", "missing"]),
    "unknown word": (contact(coeff="pair_coeff 1 1 sticky 1 1 1"),
                     ["rbc/jkr", "sticky", "adhesive, repulsive, none"]),
    "adhesive too short": (contact(coeff="pair_coeff 1 1 adhesive 1 1"),
                           ["rbc/jkr adhesive", "3 values (K sigma R)", "2"]),
    "repulsive too long": (contact(coeff="pair_coeff 1 1 repulsive 1 1 1"),
                           ["rbc/jkr repulsive", "2 values (K R)", "3"]),
    "none with values": (contact(coeff="pair_coeff 1 1 none 1"), ["rbc/jkr none", "0 values"]),
    "K zero": (contact(coeff="pair_coeff 1 1 adhesive 0 1e-3 0.3"), ["adhesive K", "0", "> 0"]),
    "sigma negative": (contact(coeff="pair_coeff 1 1 adhesive 1 -1 0.3"),
                       ["adhesive sigma", "-1", "> 0"]),
    "R not a number": (contact(coeff="pair_coeff 1 1 repulsive 1 nan"),
                       ["rbc/jkr repulsive R value 'nan' must be a finite number"]),
    "K no number": (contact(coeff="pair_coeff 1 1 repulsive hard 0.3"), ["'hard'", "pair_coeff"]),
    "too soft": (contact("pair_style rbc/jkr 1", "pair_coeff 1 1 adhesive 0.01 1e-3 0.3"),
                 ["rbc/jkr", "types 1 1", "overlap by", "sigma/K must be < 0.0826993"]),
    "no mixing": (contact(coeff=ADHESIVE + "\npair_coeff 2 2 none",
                          create_box="create_box 2 box angle/types 1"),
                  ["rbc/jkr", "does not mix", "types 1 2"]),
    "shift": (contact(coeff=ADHESIVE + "\npair_modify shift yes"), ["rbc/jkr", "shift"]),
    "tail": (contact(coeff=ADHESIVE + "\npair_modify tail yes", boundary="boundary p p p",
                     fluid=SHEAR["fluid"].split(" wall")[0]), ["rbc/jkr", "tail"]),
    "no membrane": (contact(membrane=None, ib=None, fluid=None, thermo=None),
                    ["rbc/jkr", "needs a fix rbc/membrane"]),
    "atom of no cell":
        (contact(coeff=ADHESIVE + "\nmass 1 1\ncreate_atoms 1 single 1 1 1\ngroup red molecule 1",
                 membrane=SHEAR["membrane"].replace("all", "red")),
         ["rbc/jkr", "atom 163", "no cell", "none"]),
    "cell of two types": (contact(coeff="pair_coeff * * repulsive 1 0.3\nset atom 7 type 2",
                                  create_box="create_box 2 box angle/types 1"),
                          ["rbc/jkr", "molecule ID 1", "one type"]),
}


class Contact(BadInput):
    def test_before_the_first_step(self):
        self.check(CONTACT_ERRORS)

    def test_on_two_ranks(self):
        self.check({name: CONTACT_ERRORS[name]
                    for name in ("atom of no cell", "cell of two types", "cutoff zero")},
                   ranks=2)


    def test_the_argument_is_marked(self):
        for pair, coeff, wrong in (("pair_style rbc/jkr -1", "", "-1"),
                                   ("pair_style rbc/jkr 0.5 own yes", "", "own"),
                                   ("pair_style hybrid rbc/jkr -1", "", "-1"),
                                   ("pair_style rbc/jkr 0.5", "pair_coeff 1 1 repulsive 1 -2",
                                    "-2")):
            with self.subTest(pair=pair, coeff=coeff):
                printed = attempt(scene(**contact(pair, coeff))).printed
                line, marks = re.search(r"^(Last input line: .*)\n( *\^+ *)$", printed,
                                        re.MULTILINE).groups()
                self.assertEqual(line[marks.index("^"):marks.rindex("^") + 1], wrong, printed)


class Stops(DuringARun):
    def test_beyond_the_skin_within_a_step(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["pair rbc/jkr", "moved by", "more than 0.1", "raise the skin",
                            "molecule ID 1"], ranks, earliest=0, latest=20,
                           dumped=False, neighbor="neighbor 0.1 bin",
                           fluid=SHEAR["fluid"].replace("zlo 0 0 0", "zlo 0.004 0 0")
                           .replace("0.0012", "0.004"), **contact())

    def test_a_triangle_stretched_too_far(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check(["pair rbc/jkr", "edge longer than", "molecule ID 1",
                            "comm_modify cutoff"], ranks,
                           earliest=0, latest=0, dumped=False, run="run 10",
                           last="group one id 7\ndisplace_atoms one move 0 0 4", **contact())


if __name__ == "__main__":
    unittest.main()
