"""The rooms of the code and who includes whom, read from the lines #include of all source files.

`python3 tests/python/rooms.py` prints the table of arrows, `--write` puts it into CONTRIBUTING.md.
"""

import argparse
import re
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path("src/USER-RBC")
STYLES = "styles"    # the files that lie flat in the package

# The rooms that each room may include, besides itself, those below these, and so on.
RULE = {
    STYLES: ("coupling", "packing", "vessel", "output", "support"),
    "coupling": ("cells", "motion", "fluid", "support"),
    "cells": ("membrane", "contact", "geometry", "support"),
    "membrane": ("geometry",),
    "contact": ("geometry",),
    "packing": ("geometry",),
    "vessel": ("geometry",),
    "output": ("geometry",),
    "fluid": (),
    "motion": (),
    "geometry": (),
    "support": (),
}
SEES_LAMMPS = (STYLES, "coupling", "cells", "support")
# System headers with the suffix .h that a room without LAMMPS may include.
LIBRARIES = {"mpi.h", "fftw3.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
BEGIN, END = "<!-- rooms.py: arrows -->", "<!-- rooms.py: end -->"


def below(room):
    """All rooms that a room may include, itself among them."""
    found = {room}
    for other in RULE[room]:
        found |= below(other)
    return found


def room_of(path):
    """Room of a file, given relative to the top folder."""
    if path.parts[0] == "fluid":
        return "fluid"
    inner = path.relative_to(PACKAGE).parts
    return inner[0] if len(inner) > 1 else STYLES


class Code:
    """All files of a source tree and what they include.

    files: paths relative to the tree. includes: (file, name, quoted, target) of each line #include;
    the target is the file of ours that is meant, or None.
    """

    def __init__(self, root=ROOT):
        folders = ("fluid", PACKAGE)
        self.files = sorted(path.relative_to(root) for folder in folders
                            for path in (root / folder).rglob("*") if path.suffix in (".h", ".cpp"))
        ours = set(self.files)
        names = {}
        for file in self.files:
            names.setdefault(file.name, []).append(file)
        self.includes = []
        self.without_room = []    # (file, name): a header of ours that is named without its room
        for file in self.files:
            text = (root / file).read_text()
            for mark, name in INCLUDE.findall(text):
                flat = PACKAGE / name
                target = next((path for path in (flat, Path(name)) if path in ours), None)
                if target is None and Path(name).name in names:
                    # LAMMPS has headers of its own, with which none of ours shares its name.
                    target = names[Path(name).name][0]
                    self.without_room.append((file, name))
                self.includes.append((file, name, mark == '"', target))

    def arrows(self):
        """Counter of (room, other room) over all includes from one room into another."""
        return Counter((room_of(file), room_of(target)) for file, _, _, target in self.includes
                       if target is not None and room_of(file) != room_of(target))

    def against_the_rule(self):
        """(file, name) of the includes that point to a room that is not below."""
        return [(file, name) for file, name, _, target in self.includes
                if target is not None and room_of(target) not in below(room_of(file))]

    def lammps_where_it_must_not_be(self):
        """(file, name) of LAMMPS headers in rooms, or in files of rooms, that must not see them."""
        found = []
        for file, name, quoted, target in self.includes:
            foreign = quoted or name.endswith(".h") and name not in LIBRARIES
            if target is None and foreign:
                room = room_of(file)
                if room not in SEES_LAMMPS or room != STYLES and not file.name.startswith("rbc_"):
                    found.append((file, name))
        return found

    def header_rings(self):
        """Rings of headers that include each other."""
        return rings({(file, target) for file, _, _, target in self.includes
                      if target is not None and file.suffix == ".h"})

    def unit_rings(self):
        """Rings of units (a header and its source file) that need each other."""
        return rings({(file.with_suffix(""), target.with_suffix(""))
                      for file, _, _, target in self.includes if target is not None} -
                     {(file.with_suffix(""),) * 2 for file in self.files})

    def room_rings(self):
        return rings(set(self.arrows()))

    def table(self):
        """Markdown: each room and those it includes, with the number of includes."""
        arrows = self.arrows()
        lines = ["| room | includes (how often) |", "|---|---|"]
        for room in RULE:
            others = [f"{other} ({arrows[room, other]})" for other in RULE if arrows[room, other]]
            lines.append(f"| {room} | {', '.join(others) or 'none of ours'} |")
        return "\n".join(lines)


def rings(arrows):
    """Sets of nodes that reach each other, among them single ones with an arrow to themselves."""
    after = {}
    for node, other in arrows:
        after.setdefault(node, set()).add(other)
    reach = {}
    for start in after:
        seen, front = set(), [start]
        while front:
            for other in after.get(front.pop(), ()):
                if other not in seen:
                    seen.add(other)
                    front.append(other)
        reach[start] = seen
    found = {frozenset(other for other in seen if node in reach.get(other, ()))
             for node, seen in reach.items() if node in seen}
    return sorted(sorted(map(str, ring)) for ring in found)


def written_table(text):
    """The table that stands in CONTRIBUTING.md between the marks."""
    return text.split(BEGIN + "\n")[1].split("\n" + END)[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", help="put the table into CONTRIBUTING.md")
    write = parser.parse_args().write
    table = Code().table()
    if write:
        path = ROOT / "CONTRIBUTING.md"
        text = path.read_text()
        before, behind = text.split(BEGIN + "\n")[0], text.split("\n" + END)[1]
        path.write_text(f"{before}{BEGIN}\n{table}\n{END}{behind}")
    else:
        print(table)


if __name__ == "__main__":
    main()
