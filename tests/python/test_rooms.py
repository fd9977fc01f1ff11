"""Who may include whom: every line #include of the code against the rule of CONTRIBUTING.md."""

import re
import shutil
import tempfile
import unittest
from pathlib import Path

from rooms import BEGIN, END, PACKAGE, ROOT, RULE, SEES_LAMMPS, STYLES, Code, room_of, written_table


def listing(found):
    return "".join(f"\n  {' '.join(map(str, entry))}" for entry in found)


class Rooms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.code = Code()
        print(f"\n{cls.code.table()}")

    def nothing(self, found, what):
        self.assertFalse(found, f"{what}:{listing(found)}")

    def test_the_code_is_read(self):
        self.assertGreater(len(self.code.files), 100)
        self.assertGreater(sum(self.code.arrows().values()), 50)

    def test_every_room_has_a_rule(self):
        self.assertEqual({room_of(file) for file in self.code.files}, set(RULE))

    def test_arrows_point_downward(self):
        self.nothing(self.code.against_the_rule(), "includes against the rule")

    def test_no_ring_of_rooms(self):
        self.nothing(self.code.room_rings(), "rooms that need each other")

    def test_no_ring_of_headers(self):
        self.nothing(self.code.header_rings(), "headers that include each other")

    def test_no_ring_of_styles(self):
        # Within a room two classes may know each other, if one of them does so in its source only.
        found = self.code.unit_rings()
        print(f"units that need each other:{listing(found)}")
        self.nothing([ring for ring in found
                      if all(room_of(Path(file)) == STYLES for file in ring)],
                     "styles that need each other")

    def test_headers_are_included_with_their_room(self):
        self.nothing(self.code.without_room, "headers of ours included without their room")

    def test_lammps_is_seen_where_it_may_be(self):
        self.nothing(self.code.lammps_where_it_must_not_be(), "headers of LAMMPS")

    def test_files_that_see_lammps_are_named_so(self):
        wrong = [(file,) for file in self.code.files
                 if file.name.startswith("rbc_") and room_of(file) not in SEES_LAMMPS]
        self.nothing(wrong, "files rbc_* in rooms without LAMMPS")

    def test_the_table_in_contributing_has_these_arrows(self):
        def arrows(table):
            return re.sub(r" \(\d+\)", "", table)
        text = (ROOT / "CONTRIBUTING.md").read_text()
        self.assertIn(BEGIN, text)
        self.assertIn(END, text)
        self.assertEqual(arrows(written_table(text)), arrows(self.code.table()),
                         "run python3 tests/python/rooms.py --write")


class Faults(unittest.TestCase):
    """Each kind of fault is found in a copy of the code that has it."""

    def faulty(self, file, line):
        """The code with a line added to a file, which is made where there is none."""
        folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        for top in ("fluid", PACKAGE):
            shutil.copytree(ROOT / top, folder / top)
        with open(folder / file, "a") as end:
            end.write(line + "\n")
        return Code(folder)

    def test_arrow_upward(self):
        for file, header in (("fluid/box.h", "geometry/point_bins.h"),
                             (PACKAGE / "motion/motion.h", "fluid/flow.h"),
                             (PACKAGE / "cells/rbc_local_cells.h", "packing/cell_packing.h"),
                             (PACKAGE / "geometry/closest_point.h", "support/stopwatch.h"),
                             (PACKAGE / "coupling/rbc_driven_flow.h", "fix_rbc_ib.h")):
            with self.subTest(file):
                found = self.faulty(file, f'#include "{header}"').against_the_rule()
                self.assertEqual(found, [(Path(file), header)])

    def test_rings(self):
        code = self.faulty("fluid/box.h", '#include "fluid/flow.h"')
        self.assertTrue(any("fluid/box.h" in ring for ring in code.header_rings()))
        self.assertFalse(code.room_rings())
        code = self.faulty("fluid/box.h", '#  include "coupling/rbc_driven_flow.h"')
        self.assertIn(["coupling", "fluid"], code.room_rings())
        code = self.faulty(PACKAGE / "fix_rbc_fluid.cpp", '#include "fix_rbc_ib.h"')
        self.assertIn([str(PACKAGE / "fix_rbc_fluid"), str(PACKAGE / "fix_rbc_ib")],
                      code.unit_rings())

    def test_header_without_its_room(self):
        code = self.faulty("fluid/flow.cpp", '#include "halo.h"')
        self.assertIn((Path("fluid/flow.cpp"), "halo.h"), code.without_room)

    def test_lammps(self):
        for file, header in (("fluid/flow.cpp", '"comm.h"'), ("fluid/flow.cpp", "<lammps/atom.h>"),
                             (PACKAGE / "motion/gmres.h", '"error.h"'),
                             (PACKAGE / "support/plain.h", '"pointers.h"')):
            with self.subTest(file):
                found = self.faulty(file, f"#include {header}").lammps_where_it_must_not_be()
                self.assertEqual(found, [(Path(file), header.strip('"<>'))])


if __name__ == "__main__":
    unittest.main()
