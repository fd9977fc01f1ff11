"""Tables of error against run time in the READMEs of the examples are what converge.py wrote, and
what it makes of their values."""
import csv
import re
import shlex
import unittest
from pathlib import Path

import converge
import converge_report
import numpy as np

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
NOT_VARIED = {"measure", "value", "noise", "from_limit", "error_below", "scale", "core_seconds"}
TABLES = sorted(EXAMPLES.glob("*/converge.csv"))


def section_of(path):
    """Of the README beside a table."""
    text = (path.parent / "README.md").read_text(encoding="utf-8")
    section = re.split(r"^## Error against run time$", text, flags=re.MULTILINE)[1]
    return section.split("\n## ")[0]


def command_in(section):
    return section.split("```")[1].replace("\\\n", "")


def lines_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def row_of(line):
    """Of a table in a README, from a row of converge.csv."""
    words = [word for name, value in line.items() if name not in NOT_VARIED
             for word in value.split(":")]
    error = 100 * float(line["error_below"]) / abs(float(line["scale"]))
    numbers = (f"{float(line['value']):.4g}", f"{float(f'{error:.2g}'):g} %",
               f"{float(line['core_seconds']):.2g}")
    return "| " + " | ".join([*words, *numbers]) + " |"


def options_of(path):
    """What the command above a table asks for, and what it varies."""
    script, *words = shlex.split(command_in(section_of(path)), comments=True)[1:]
    parser = converge.options()
    arguments = parser.parse_args([str(path.parent / script), *words])
    changes, _ = converge.checked(parser, arguments)
    return arguments, changes


def place_of(line, changes):
    return tuple([one.word(n) for n in range(len(one.values))].index(line[one.title])
                 for one in changes)


def errors_of_ends(lines, arguments, changes):
    """What converge.py makes of the values of one measure at the ends of runs."""
    runs = [converge.Run(place_of(line, changes),
                         np.array([[0, 0, line["value"]], [1, 1, line["value"]]], dtype=float), 0)
            for line in lines]
    analysis = converge_report.Analysis(lines[0]["measure"], "last", changes, runs,
                                        *converge.fitted(runs, changes, 2, arguments))
    return [analysis.error(run.setting) for run in runs]


class Tables(unittest.TestCase):
    def test_are_those_of_the_files(self):
        self.assertGreater(len(TABLES), 3)
        for path in TABLES:
            with self.subTest(path.parent.name):
                section, lines = section_of(path), lines_of(path)
                rows = [line for line in section.splitlines() if re.match(r"\| .*\d \|$", line)]
                self.assertEqual(rows, [row_of(line) for line in lines])
                command = command_in(section)
                self.assertIn(f"../../scripts/converge.py in.{path.parent.name} ", command)
                self.assertIn(lines[0]["measure"], command)
                # each list of values is in the command, from coarse to fine
                for name in lines[0].keys() - NOT_VARIED:
                    values = list(dict.fromkeys(line[name] for line in lines))
                    listed = re.search(rf" {re.escape(name)}=(\S+)", command)[1].split(",")
                    self.assertEqual(set(listed), set(values))
                self.assertIn("](converge.png)", section)
                self.assertTrue((path.parent / "converge.png").is_file())

    def test_have_the_errors_of_their_values(self):
        """Of values at the ends of runs, which are all that counts there."""
        seen = 0
        for path in TABLES:
            arguments, changes = options_of(path)
            for measure in arguments.measure if arguments.take == "last" else ():
                with self.subTest(f"{path.parent.name} {measure}"):
                    lines = [line for line in lines_of(path) if line["measure"] == measure]
                    for line, error in zip(lines, errors_of_ends(lines, arguments, changes)):
                        written = [float(line[name]) for name in ("from_limit", "error_below")]
                        np.testing.assert_allclose(written, error, rtol=0,
                                                   atol=1e-6 * abs(float(line["scale"])))
                    seen += 1
        self.assertGreater(seen, 10)


if __name__ == "__main__":
    unittest.main()
