#!/usr/bin/python3
"""Writes doc/validation.rst from doc/validation.rst.in, in which `{drag.roma3[1]:1}` stands for a
number with one digit, of the figures that validation_figures.py takes from tables in the
repository.

validation.py               prints the page
validation.py --update      writes it
"""
import re
import textwrap

from rbc import command_line    # before numpy, which may be missing
import validation_figures
from validation_tables import ROOT

PAGE = ROOT / "doc" / "validation.rst"
COLUMNS = 100
CELL = re.compile(r"^(   \* - |     - )(.+(?:\n {7}.+)*)", re.MULTILINE)


def wrapped(first, rest, text):
    text = " ".join(line.strip() for line in text.splitlines())
    return textwrap.fill(text, COLUMNS, initial_indent=first,
                         subsequent_indent=rest, break_long_words=False, break_on_hyphens=False)


def filled(first, rest, text, figures):
    """Lines with numbers in them, wrapped again."""
    return wrapped(first, rest, text.format(**figures)) if "{" in text else first + text


def page(template, figures):
    """The template with its numbers; what has some is wrapped again."""
    blocks = template.split("\n\n")
    for n, block in enumerate(blocks):
        if block.startswith("   * - "):
            blocks[n] = CELL.sub(lambda cell: filled(cell[1], 7 * " ", cell[2], figures), block)
        else:
            blocks[n] = filled("", "", block, figures)
    return "\n\n".join(blocks).rstrip("\n") + "\n"


def written_page():
    return page(PAGE.with_suffix(".rst.in").read_text(encoding="utf-8"),
                validation_figures.figures())


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--update", action="store_true", help="write doc/validation.rst")
    arguments = parser.parse_args()
    text = written_page()
    if arguments.update:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
