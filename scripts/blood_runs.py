"""Runs of examples/suspension/in.suspension in a folder for each, in pieces that go on from restart
files, and what their files say: histories, cost, sizes of aggregates."""
import re
import shutil
from pathlib import Path
from typing import NamedTuple

import example_study    # before numpy, which may be missing
import numpy as np

from rbc import thermo_log
from rbc.aggregates import mean_classes
from rbc.tables import read_table
from rbc.snapshots import surfaces
from rbc.surfaces import read_cell_ids

SCRIPT = Path(example_study.TOP) / "examples" / "suspension" / "in.suspension"
SECONDS = "core_seconds.txt"        # in the folder of a run
KEPT = "kept"                       # in it, data files as the last whole piece left them
RESTART, NEXT = "last.restart", "next.restart"    # what a piece reads, what it leaves
LIMIT = "Wall time limit reached"   # in the log of a piece that is not the last
ENDED = "Total wall time"           # in the log of a piece that was not killed


def log_table(path):
    """Columns by name of the table in a LAMMPS log; a line cut short at the end is left out. Empty
    if the run has not begun."""
    for names, rows in thermo_log.tables(path.read_text(encoding="utf-8")):
        return dict(zip(names, rows.T))
    return {}


def logs(folder):
    """Of the pieces of a run: log.lammps, log.lammps.2, log.lammps.3, ..."""
    return sorted(folder.glob("log.lammps*"), key=lambda log: int(log.suffix[1:])
                  if log.suffix[1:].isdigit() else 1)


def history(folder):
    """Tables of the logs of all pieces, one after the other; the first step of a piece is the last
    of the one before."""
    first, *others = filter(None, map(log_table, logs(folder)))
    for table in others:
        table["f_ib[8]"] += first["f_ib[8]"][-1]    # counted from the start of each piece
        first = {name: np.concatenate([first[name], table[name][1:]]) for name in first}
    return first


def has_begun(folder):
    """Whether there is a history."""
    return any(map(log_table, logs(folder)))


def last_log(folder):
    """Text of the log of the last piece, empty if there is none."""
    return logs(folder)[-1].read_text(encoding="utf-8") if logs(folder) else ""


def is_finished(folder):
    """Whether the last piece of the run went to its end."""
    return ENDED in last_log(folder) and LIMIT not in last_log(folder)


def keep_whole_piece(folder):
    """What the last piece left is what the next begins with."""
    if ENDED not in last_log(folder):
        return
    if (folder / NEXT).exists():
        (folder / NEXT).replace(folder / RESTART)
    for path in folder.glob("*.dat"):
        shutil.copy(path, folder / KEPT)


def drop_killed_piece(folder):
    """Data files as they were before a piece that did not come to its end, which leaves no log."""
    if not logs(folder) or ENDED in last_log(folder):
        return
    logs(folder)[-1].unlink()
    for path in folder.glob("*.dat"):
        path.unlink()
    for path in (folder / KEPT).glob("*.dat"):
        shutil.copy(path, folder)


def run_piece(arguments, folder, variables, templates=example_study.POTENTIALS):
    """Runs in.suspension, or its next piece, in a folder, which keeps the seconds of processors
    that all pieces took. Returns what subprocess.run does."""
    (folder / KEPT).mkdir(parents=True, exist_ok=True)
    keep_whole_piece(folder)
    drop_killed_piece(folder)
    pieces = len(logs(folder))
    before = example_study.processor_seconds()
    log = f"log.lammps.{pieces + 1}" if pieces else "log.lammps"
    variables = {**variables, "pieces": pieces, "left": NEXT}
    done = example_study.run_script(arguments, SCRIPT, folder, variables, templates, log)
    seconds = example_study.processor_seconds() - before
    if pieces:
        seconds += core_seconds(folder)
    (folder / SECONDS).write_text(f"{seconds:.1f}\n", encoding="utf-8")
    keep_whole_piece(folder)
    return done


def core_seconds(folder):
    """That all pieces of a run took."""
    return float((folder / SECONDS).read_text(encoding="utf-8"))


def said(done):
    """Errors and warnings of a run."""
    return re.findall(r"^(?:ERROR|WARNING).*", done.stdout, re.MULTILINE)


def cell_count(folder):
    log = (folder / "log.lammps").read_text(encoding="utf-8")
    return int(re.search(r"^Created (\d+) cells", log, re.MULTILINE)[1])


def box(folder):
    """Lengths of the box of a run."""
    log = (folder / "log.lammps").read_text(encoding="utf-8")
    corner = re.search(r"^Created orthogonal box = \(0 0 0\) to \((.*)\)", log, re.MULTILINE)[1]
    return np.array(corner.split(), float)


def aggregate_sizes(path):
    """Cells in each aggregate of a file of surfaces."""
    return np.unique(read_cell_ids(path).aggregates, return_counts=True)[1]


def aggregate_statistics(folder, cells, table, start):
    """Sizes of aggregates from a strain of `start` on."""
    strain, steps = table["v_sheared"], table["Step"]
    late = strain >= start
    classes = mean_classes(folder / "classes.dat", steps[late][0])
    shares = classes.fractions(False)
    sizes = np.concatenate([aggregate_sizes(name) for step, name in surfaces(folder)
                            if np.interp(step, steps, strain) >= start] or [[1]])
    return {
        "classes": classes,
        "median": np.median(sizes[sizes > 1]) if (sizes > 1).any() else np.nan,
        "of_cells": np.median(np.repeat(sizes, sizes)),
        "of_2_or_3": shares[classes.edges == 2].sum(),
        "of_4_to_7": shares[classes.edges == 4].sum(),
        "mean": cells / table["c_agg[1]"][late].mean(), "largest": table["c_agg[4]"][late].mean(),
        "singles": classes.aggregates[0] / cells}


def measures(folder, settled):
    """Of a run, by name; means are from a strain of `settled`, or half of all, on."""
    cells, table = cell_count(folder), history(folder)
    strain = table["v_sheared"]
    start = min(settled, strain[-1] / 2)
    blood, counts = read_table(folder / "blood.dat"), read_table(folder / "sizes.dat")
    volumes = np.array([blood["v_least"], blood["v_most"]])
    return {
        "cells": cells, "strain": strain[-1], "hematocrit": table["v_filled"].min(),
        "core_seconds": core_seconds(folder), "again": table["f_ib[8]"][-1],
        "viscosity": table["v_relative"][strain >= start].mean(),
        **aggregate_statistics(folder, cells, table, start),
        "lost": cells - round(counts["c_agg[1]"][-1] * counts["c_agg[2]"][-1]),
        "volume": abs(volumes / volumes[0, 0] - 1).max()}


class Cost(NamedTuple):
    """Of all pieces of a run, from their logs."""
    parts: dict          # core seconds of the parts in the step cost tables
    loops: float         # core seconds of the runs, whatever they did
    steps: int
    solves: int
    megabytes: float     # of rank 0 at most, times the ranks


def read_cost(folder):
    parts, loops, steps, solves, megabytes = {}, 0, 0, 0, 0
    for log in logs(folder):
        text = log.read_text(encoding="utf-8")
        counted = re.search(r"step cost: (\d+) solves", text)
        if not counted:
            continue
        ended = re.search(r"^Loop time of (\S+) on (\d+) procs for (\d+)", text, re.M)
        seconds, ranks, stepped = ended.groups()
        loops += int(ranks) * float(seconds)
        solves, steps = solves + int(counted[1]), steps + int(stepped)
        rows = re.findall(r"^(\w+) +\| +(\S+) \| +\S+ \| +\S+ \| +\S+$", text, re.M)
        for name, seconds in rows:
            parts[name] = parts.get(name, 0) + float(seconds) * int(counted[1])
        largest = re.search(r"^Maximum resident set size: (\S+) Mbyte", text, re.M)
        megabytes = max(megabytes, int(ranks) * float(largest[1]) if largest else 0)
    return Cost(parts, loops, steps, solves, megabytes)


def loop_hours(log):
    """Hours on the wall that the run of a log took."""
    return float(re.search(r"^Loop time of (\S+)", log, re.MULTILINE)[1]) / 3600
