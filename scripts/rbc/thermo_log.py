"""Tables of thermo output in a log of LAMMPS."""
import numpy as np

from rbc.errors import InputError
from rbc.text_files import Columns, refuse_others


def numbers(line, count):
    """Of a line that has that many words, all of them numbers; None of another."""
    words = line.split()
    if len(words) != count:
        return None
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


def tables(text):
    """(names, rows) of each run that printed a row. A line cut short at the end is left out."""
    found, names = [], None
    for line in text.rpartition("\n")[0].splitlines():
        if line.startswith("Loop time"):
            names = None
        elif "Step" in line.split():
            names = line.split()
            found.append((names, []))
        elif names and (row := numbers(line, len(names))):
            found[-1][1].append(row)
    return [(names, np.array(rows)) for names, rows in found if rows]


def read_log(path):
    """{column: values} of each run in a log."""
    with open(path, encoding="utf-8", errors="replace") as stream:
        text = stream.read()
    refuse_others(path, text, "log")
    found = tables(text)
    if not found:
        raise InputError(f"{path} holds no thermo output that begins with Step")
    return [Columns(zip(names, rows.T)) for names, rows in found]
