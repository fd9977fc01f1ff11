"""A minute of mutated decks, the same each time: none ends as no run may. decks.py runs more of
them."""

import unittest
from pathlib import Path

import decks

SECONDS = 60


class MutatedDecks(unittest.TestCase):
    def test_none_ends_as_no_run_may(self):
        options = decks.parse(["--seed", "18", "--count", "60", "--seconds", str(SECONDS), "--jobs",
                               "2", "--folder", str(Path.cwd() / "decks")])
        ends = decks.campaign(options)
        self.assertEqual(decks.report(ends), [])
        # mutations leave some decks whole: otherwise nothing but the reading of input is tried
        self.assertTrue(any(end[2] == "well" for end in ends))


class Verdicts(unittest.TestCase):
    """What counts as a finding."""

    def test_ends_of_runs(self):
        table = "   Step   Temp\n  0  {}\nLoop time of 1\n"
        for expected, code, printed in (
                ("well", 0, table.format(1.5)),
                ("well", 0, table.format(1.5) + "nan"),
                ("not finite", 0, table.format("-nan")),
                ("not finite", 0, table.format("inf")),
                ("error", 1, "ERROR: Fix rbc/ib ...\n"),
                ("error", 1, "ERROR on proc 0: ...\n"),
                ("no message", 1, "LAMMPS (4 Feb 2025)\n"),
                ("exception", 1, "Exception: basic_filebuf::underflow\n"),
                ("no memory", 1, "Exception: std::bad_alloc\n"),
                ("signal", -11, ""),
                ("signal", 139, ""),
                ("signal", 139, "ERROR: ...\n"),
                ("sanitizer", 1, "x.cpp:3:4: runtime error: signed integer overflow\n"),
                ("hang", None, "ERROR: ...\n")):
            with self.subTest(expected, printed=printed):
                self.assertEqual(decks.verdict(code, printed), expected)

    def test_a_deck_follows_from_its_number(self):
        originals = decks.bases()
        first, again, other = (decks.Deck(originals, 18, number) for number in (7, 7, 8))
        self.assertEqual(first.files, again.files)
        self.assertNotEqual(first.files, other.files)

    def test_decks_are_changed_again(self):
        """Among these is a mesh with a damaged triangle."""
        originals = decks.bases()
        for number in range(100):
            self.assertTrue(decks.Deck(originals, 29, number).changes)


if __name__ == "__main__":
    unittest.main()
