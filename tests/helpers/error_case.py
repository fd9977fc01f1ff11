"""Scripts that must end with an error: before the first step, or during a run."""

import re
import unittest

import numpy as np

from lammps_case import attempt, dump_line, in_parallel, scene


class BadInput(unittest.TestCase):
    """An error before the first step names style, keyword, value and what is allowed."""

    def check(self, table, ranks=1, files=None):
        results = in_parallel(lambda name: attempt(scene(**table[name][0]), ranks, files=files),
                              [(name,) for name in table])
        for name, result in zip(table, results):
            with self.subTest(name):
                self.refused(result, table[name][1])

    def refused(self, result, words):
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertTrue(result.error, result.printed)
        for word in words:
            self.assertIn(word.lower(), result.error.lower(), result.printed)
        steps = [step for table in result.tables() for step in table["Step"]]
        self.assertTrue(all(step == 0 for step in steps), result.printed)


class DuringARun(unittest.TestCase):
    """A run that must stop says where, and what it wrote before is complete."""

    def check(self, words, ranks=1, earliest=1, latest=10**9, dumped=True, files=None, **changes):
        changes.setdefault("run", "run 100")
        script = scene(dump=dump_line(2), **changes)
        result = attempt(script, ranks, files=files)
        self.assertNotEqual(result.code, 0, result.printed)
        self.assertNotIn("Loop time", result.printed)
        for word in words:
            self.assertIn(word.lower(), result.error.lower(), result.printed)
        step = re.search(r"at step (\d+)", result.error)
        self.assertTrue(step, result.printed)
        step = int(step.group(1))
        self.assertGreaterEqual(step, earliest, result.error)
        self.assertLessEqual(step, latest, result.error)
        position = re.search(r"\(([^ ,]+), ([^ ,]+), ([^ ,]+)\)", result.error)
        self.assertTrue(position, result.printed)
        if dumped:
            dump = result.dump()
            # what happens in a step comes before its output
            last = step - 1 if step % 2 else step - 2
            self.assertEqual(dump.steps, list(range(0, last + 1, 2)), result.error)
            self.assertTrue(all(frame.shape == (162, 9) for frame in dump.frames))
        return result, step, np.array([float(x) for x in position.groups()])
