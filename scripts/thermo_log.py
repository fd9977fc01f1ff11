"""Tables of thermo output in a log of LAMMPS."""
import numpy as np


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
