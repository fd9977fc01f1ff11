"""Which reader the files of a run are for, and columns that say which there are."""
import re

import numpy as np

from rbc.errors import InputError

HEAD = 100_000    # characters that tell the kind
KINDS = {         # what a line begins with, what the file is, what reads it
    "log": (r"LAMMPS \(", "a log", "read_log"),
    "blocks": (r"# (Row |TimeStep Number-of-rows)", "a file of mode vector",
               "read_cell_table or read_ave_time"),
    "table": (r"# TimeStep ", "a file of mode scalar", "read_table"),
    "grid": (r"ITEM: GRID CELLS", "a dump of a grid", "read_grids"),
    "dump": (r"ITEM: ATOMS", "a dump of atoms", "read_dump"),
    "surfaces": (r'<VTKFile type="P?PolyData"', "a file of surfaces", "read_surfaces"),
    "vtr": (r'<VTKFile type="RectilinearGrid"', "a file of a grid", "read_grid")}


class Columns(dict):
    """Of a table, by name."""

    def __missing__(self, name):
        raise InputError(f"there is no {name}; there are {', '.join(map(str, self))}")


def kind_of(text):
    """Key of KINDS, or None, of a file whose text begins like this."""
    for kind, (begin, *_) in KINDS.items():
        if re.search(f"^{begin}", text, re.MULTILINE):
            return kind
    return None


def read_head(path):
    with open(path, encoding="utf-8", errors="replace") as stream:
        return stream.read(HEAD)


def refuse_others(path, text, *own):
    """What another reader is for."""
    kind = kind_of(text[:HEAD])
    if kind is not None and kind not in own:
        _, what, reader = KINDS[kind]
        raise InputError(f"{path} is {what}: use {reader}")


def refuse_all_but_vtk(path, own):
    """VTK would print what is wrong."""
    text = read_head(path)
    refuse_others(path, text, own)
    if "<VTKFile" not in text:
        raise InputError(f"{path} is not {KINDS[own][1]} of VTK")


def as_numbers(path, words):
    """An array of a list of words, or of lists that are equally long."""
    try:
        return np.array(words, dtype=float)
    except ValueError:
        raise InputError(f"{path} has words among its numbers, or lines of different length"
                         ) from None
