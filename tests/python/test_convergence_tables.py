"""Tables of error against run time in the READMEs of the examples are what converge.py wrote."""
import csv
import re
import unittest
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
NOT_VARIED = {"measure", "value", "noise", "from_limit", "error_below", "scale", "core_seconds"}
TABLES = sorted(EXAMPLES.glob("*/converge.csv"))


def row_of(line):
    """Of a table in a README, from a row of converge.csv."""
    words = [word for name, value in line.items() if name not in NOT_VARIED
             for word in value.split(":")]
    error = 100 * float(line["error_below"]) / abs(float(line["scale"]))
    numbers = (f"{float(line['value']):.4g}", f"{float(f'{error:.2g}'):g} %",
               f"{float(line['core_seconds']):.2g}")
    return "| " + " | ".join([*words, *numbers]) + " |"


class Tables(unittest.TestCase):
    def test_are_those_of_the_files(self):
        self.assertGreater(len(TABLES), 3)
        for path in TABLES:
            with self.subTest(path.parent.name):
                text = (path.parent / "README.md").read_text(encoding="utf-8")
                section = re.split(r"^## Error against run time$", text, flags=re.MULTILINE)[1]
                section = section.split("\n## ")[0]
                with open(path, encoding="utf-8") as file:
                    lines = list(csv.DictReader(file))
                rows = [line for line in section.splitlines() if re.match(r"\| .*\d \|$", line)]
                self.assertEqual(rows, [row_of(line) for line in lines])
                command = section.split("```")[1].replace("\\\n", "")
                self.assertIn(f"../../scripts/converge.py in.{path.parent.name} ", command)
                self.assertIn(lines[0]["measure"], command)
                # each list of values is in the command, from coarse to fine
                for name in lines[0].keys() - NOT_VARIED:
                    values = list(dict.fromkeys(line[name] for line in lines))
                    listed = re.search(rf" {re.escape(name)}=(\S+)", command)[1].split(",")
                    self.assertEqual(set(listed), set(values))
                self.assertIn("](converge.png)", section)
                self.assertTrue((path.parent / "converge.png").is_file())


if __name__ == "__main__":
    unittest.main()
