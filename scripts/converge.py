#!/usr/bin/python3
"""Error against run time of any input script: runs it with coarser and finer settings, fits order
and limit of what is measured, and names the cheapest setting below an error.

converge.py in.scene --vary dx=0.8,0.6,0.4 --vary shape=rbc_162,rbc_362,rbc_642 \\
    --measure "c_cell[1][7]" --within 1% --output FOLDER

Values are listed from coarse to fine. Each --vary by itself is run with the finest of the others;
--grid runs all combinations. Writes converge.csv, converge.png and a folder for each run, which is
not run again if nothing changed. doc/converge.rst says how errors are estimated.
"""
import argparse
import hashlib
import itertools
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from rbc import command_line    # before numpy, which may be missing
import numpy as np
import converge_report
import example_study
import richardson
import run_measures
from rbc import thermo_log
from rbc.errors import InputError
from scene_script import Script

RECORD = "run.json"


class Varied(NamedTuple):
    """Names that change together, their values from coarse to fine, and sizes that fall."""
    names: tuple
    values: tuple    # of tuples
    sizes: tuple
    kind: str        # of the sizes, in words
    order: float     # None: not known

    @property
    def title(self):
        return ":".join(self.names)

    def word(self, n):
        return ":".join(self.values[n])


class Run(NamedTuple):
    setting: tuple   # of places in the lists of all that is varied
    table: object    # rows of step, time and measures; None: it failed
    seconds: float


def number(word):
    try:
        return float(word)
    except ValueError:
        return None


def sizes_of(words):
    """(sizes, their kind in words) of values from coarse to fine."""
    values = [number(word) for word in words]
    if None in values:
        counts = [re.search(r"(\d+)\D*$", word) for word in words]
        if None in counts:
            raise ValueError("has a value without a number: --size NAME=... gives their sizes")
        values = [float(count[1]) for count in counts]
        return [value**-0.5 for value in values], "1/sqrt of the number in it"
    if min(values) <= 0:
        raise ValueError("has a value that is not positive: --size NAME=... gives their sizes")
    if values == sorted(values):
        return [1 / value for value in values], "1/value, as values rise from coarse to fine"
    return values, "value"


def varied(text):
    """Names and tuples of values of NAME[:NAME...]=V[:V...],..."""
    names, equals, values = text.partition("=")
    names = tuple(names.split(":"))
    values = tuple(tuple(value.split(":")) for value in values.split(","))
    if not equals or "" in names or any("" in value for value in values):
        raise argparse.ArgumentTypeError(f"{text} is not NAME=VALUE,VALUE,...")
    if len(values) < 2:
        raise argparse.ArgumentTypeError(
            f"{text} has one value: two are compared, three or more show an order")
    for value in values:
        if len(value) != len(names):
            raise argparse.ArgumentTypeError(
                f"{text} names {len(names)} variables, but {':'.join(value)} has {len(value)} "
                "values")
    return names, values


def assignment(text):
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise argparse.ArgumentTypeError(f"{text} is not NAME=VALUE")
    return name, value


def numbers(text):
    name, value = assignment(text)
    values = [number(word) for word in value.split(",")]
    if None in values or min(values) <= 0:
        raise argparse.ArgumentTypeError(f"{text} is not NAME= and positive numbers")
    return name, values


def error_asked(text):
    """(number, whether it is relative)."""
    value = number(text.removesuffix("%"))
    if value is None or not 0 < value < np.inf:
        raise argparse.ArgumentTypeError(f"{text} is neither a positive number, which has the unit "
                                         "of the measure, nor a percentage as in 1%")
    return (value / 100, True) if text.endswith("%") else (value, False)


def share(text):
    value = number(text)
    if value is None or not 0 < value <= 1:
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0 and up to 1")
    return value


def ranks(text):
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is not 1 or more")
    return int(text)


def options():
    parser = command_line.parser(__doc__)
    parser.add_argument("script", type=Path, help="input script of LAMMPS")
    parser.add_argument("--vary", type=varied, nargs="+", action="extend", required=True,
                        metavar="NAME=V,V,...",
                        help="values of an index variable from coarse to fine; NAME:NAME=V:V,V:V "
                        "changes several together, the first of which gives the size")
    parser.add_argument("--measure", nargs="+", action="extend", required=True, metavar="COLUMN",
                        help="columns as thermo_style custom takes them")
    parser.add_argument("--take", choices=("last", "mean", "series"), default="last",
                        help="the measure at the end of the run (default), its mean over the last "
                        "part of the time, or all of it, compared by root mean square over time")
    parser.add_argument("--part", type=share, default=0.5, metavar="SHARE",
                        help="of the time, at its end, for --take mean (default 0.5)")
    parser.add_argument("--within", type=error_asked, metavar="ERROR",
                        help="asked for: 1%% of the measure, or a number in its unit")
    parser.add_argument("--order", type=numbers, nargs="+", action="extend", default=[],
                        metavar="NAME=P",
                        help="known order of the error in the size")
    parser.add_argument("--size", type=numbers, nargs="+", action="extend", default=[],
                        metavar="NAME=H,H,...",
                        help="of the values, if they do not follow from these")
    parser.add_argument("--set", type=assignment, nargs="+", action="extend", default=[],
                        metavar="NAME=VALUE",
                        help="another variable of the script")
    parser.add_argument("--grid", action="store_true", help="run all combinations")
    parser.add_argument("-o", "--output", type=Path, default=Path("converge"), metavar="FOLDER",
                        help="made if it is not there (default converge)")
    parser.add_argument("--lmp", type=os.path.abspath,
                        default=command_line.default_executable())
    parser.add_argument("--ranks", type=ranks, default=1)
    return parser


def checked(parser, arguments):
    """The Varied of all that is varied, and the script."""
    if not arguments.script.is_file():
        parser.error(f"{arguments.script} is not a file")
    script = Script(arguments.script)
    if not script.can_measure():
        parser.error(f"{arguments.script} has no line that begins with run or minimize")
    known = script.variables()
    names = [name for names, _ in arguments.vary for name in names]
    asked = [("--vary", name) for name in names] + [("--set", name) for name, _ in arguments.set]
    for option, name in asked:
        if name not in known:
            parser.error(f"{option} {name}: {arguments.script} has no index variable of that name, "
                         f"it has {' '.join(known) or 'none'}")
        if [other for _, other in asked].count(name) > 1:
            parser.error(f"{option} {name}: is given twice")
    titles = [":".join(names) for names, _ in arguments.vary]
    for option, pairs in (("--order", arguments.order), ("--size", arguments.size)):
        for name, _ in pairs:
            if name not in titles:
                parser.error(f"{option} {name}: not one of those varied, {' '.join(titles)}")
    try:
        return [complete(*pair, dict(arguments.size), dict(arguments.order))
                for pair in arguments.vary], script
    except ValueError as problem:
        parser.error(str(problem))


def complete(names, values, given, orders):
    """The Varied of names and values."""
    title = ":".join(names)
    words = [value[0] for value in values]
    try:
        sizes, kind = (given[title], "as given") if title in given else sizes_of(words)
    except ValueError as problem:
        raise ValueError(f"--vary {title}={','.join(words)} {problem}") from None
    if len(sizes) != len(values):
        raise ValueError(f"--size {title} has {len(sizes)} numbers for {len(values)} values")
    if any(fine >= coarse for coarse, fine in zip(sizes, sizes[1:])):
        raise ValueError(f"--vary {title}={','.join(words)} does not go from coarse to fine: sizes "
                         f"are {' '.join(f'{size:.4g}' for size in sizes)}")
    order = orders.get(title, [None])
    if len(order) != 1:
        raise ValueError(f"--order {title} has {len(order)} numbers instead of one")
    return Varied(names, values, tuple(sizes), kind, order[0])


def settings(changes, grid):
    """Places in the lists of values, coarse ones first."""
    finest = tuple(len(one.values) - 1 for one in changes)
    if grid:
        return list(itertools.product(*(range(n + 1) for n in finest)))
    alone = [finest[:i] + (n,) + finest[i + 1:]
             for i, last in enumerate(finest) for n in range(last)]
    return [*alone, finest]


def label(changes, setting):
    return " ".join(f"{one.title}={one.word(n)}" for one, n in zip(changes, setting))


def folder_name(changes, setting):
    """As dx-0.5_shape-rbc_642, of characters that all file systems and scp take."""
    words = [f"{name}-{value}" for one, n in zip(changes, setting)
             for name, value in zip(one.names, one.values[n])]
    return re.sub(r"[^\w.+-]", "_", "_".join(words), flags=re.ASCII).rstrip(".")


def printed_by(arguments, name, folder, variables):
    """What a run prints and its core seconds; those of the run before if nothing changed."""
    record = {"script": hashlib.sha256((folder / name).read_bytes()).hexdigest(),
              "variables": variables, "ranks": arguments.ranks, "lmp": arguments.lmp,
              "built": os.stat(arguments.lmp).st_mtime_ns}
    path, screen = folder / RECORD, folder / "screen.txt"
    if path.exists() and screen.exists():
        before = json.loads(path.read_text(encoding="utf-8"))
        if {**before, "seconds": 0} == {**record, "seconds": 0}:
            return screen.read_text(encoding="utf-8"), before["seconds"]
    path.unlink(missing_ok=True)
    start = example_study.processor_seconds()
    others = {key: value for key, value in variables.items() if key != "templates"}
    done = example_study.run_script(arguments, name, folder, others,
                                    variables.get("templates", example_study.POTENTIALS),
                                    "log.lammps")
    seconds = example_study.processor_seconds() - start
    screen.write_text(done.stdout + done.stderr, encoding="utf-8")
    done.check_returncode()
    path.write_text(json.dumps({**record, "seconds": seconds}, indent=1), encoding="utf-8")
    return done.stdout, seconds


def run(arguments, script, changes, setting):
    """The Run of a setting; it says why one failed."""
    name = label(changes, setting)
    print(f"{name} ...", end=" ", flush=True)
    folder = arguments.output / folder_name(changes, setting)
    folder.mkdir(parents=True, exist_ok=True)
    often = arguments.take == "series" and script.can_print_often(arguments.measure)
    (folder / script.path.name).write_text(script.measuring(arguments.measure, often),
                                           encoding="utf-8")
    variables = {**script.folders(), **dict(arguments.set)}
    for one, n in zip(changes, setting):
        variables.update(zip(one.names, one.values[n]))
    try:
        text, seconds = printed_by(arguments, script.path.name, folder, variables)
    except subprocess.CalledProcessError as problem:
        print(f"failed\n{command_line.explanation(problem)}")
        return Run(setting, None, np.nan)
    tables = thermo_log.tables(text)
    columns = 2 + len(arguments.measure)
    if not tables or tables[-1][0][-columns:][:2] != ["Step", "Time"]:
        print(f"failed\n{folder / 'screen.txt'} has no table that ends with the measures")
        return Run(setting, None, np.nan)
    print(f"{seconds:.3g} core s")
    return Run(setting, tables[-1][1][:, -columns:], seconds)


def fitted(runs, changes, column, arguments):
    """{place of what is varied: (settings, Fit)}, runs with the finest of all others."""
    finest = tuple(len(one.values) - 1 for one in changes)
    fits = {}
    histories = {run.setting: run_measures.history(run.table, column) for run in runs}
    names = sorted(histories)
    compared, noise = run_measures.compared([histories[name] for name in names], arguments.take,
                                            arguments.part)
    values, errors = dict(zip(names, compared)), dict(zip(names, noise))
    for i, one in enumerate(changes):
        line = [name for name in names if name[:i] + name[i + 1:] == finest[:i] + finest[i + 1:]]
        if len(line) < 2:
            continue
        fits[i] = line, richardson.fit([one.sizes[name[i]] for name in line],
                                       [values[name] for name in line],
                                       [errors[name] for name in line], one.order)
    return values, errors, fits


def drop_failed_finest(changes, runs):
    """With one --vary only: without its finest settings that failed: the rest has a limit."""
    if len(changes) > 1 or runs[-1].table is not None:
        return changes
    last = max((run.setting[0] for run in runs if run.table is not None), default=0) + 1
    one, = changes
    return [one._replace(values=one.values[:last], sizes=one.sizes[:last])]


def main():
    parser = options()
    arguments = parser.parse_args()
    changes, script = checked(parser, arguments)
    command_line.check_executable(parser, arguments)
    arguments.output = arguments.output.resolve()
    arguments.output.mkdir(parents=True, exist_ok=True)
    for one in changes:
        print(f"{one.title}, coarse to fine: {' '.join(map(one.word, range(len(one.values))))}; "
              f"size: {one.kind}")
    runs = [run(arguments, script, changes, one) for one in settings(changes, arguments.grid)]
    changes = drop_failed_finest(changes, runs)
    done = [run for run in runs if run.table is not None]
    finest = tuple(len(one.values) - 1 for one in changes)
    if finest not in [run.setting for run in done] or len(done) < 2:
        raise SystemExit("the finest setting and another one must run to their end: there is no "
                         "error to tell")
    analyses = []
    for n, measure in enumerate(arguments.measure):
        try:
            analyses.append(converge_report.Analysis(
                measure, arguments.take, changes, done, *fitted(done, changes, 2 + n, arguments)))
        except InputError as problem:
            raise SystemExit(f"{measure}: {problem}") from None
    converge_report.report(analyses, arguments)
    sys.exit(len(done) < len(runs))


if __name__ == "__main__":
    main()
