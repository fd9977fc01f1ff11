"""What the study.py of the examples share: their options and how they run the example's script."""
import csv
import os
import resource
import subprocess
from pathlib import Path

from rbc import command_line    # before numpy, which may be missing
import numpy as np

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
POTENTIALS = os.path.join(TOP, "potentials")


def options(description, series=()):
    """Parser of the options that all have, read by command_line.parse. `series`: what --only
    chooses from."""
    parser = command_line.parser(description)
    command_line.add_results(parser)
    parser.add_argument("--lmp", type=os.path.abspath,
                        default=command_line.default_executable())
    parser.add_argument("--ranks", type=int, default=1)
    if series:
        parser.add_argument("--only", nargs="+", choices=list(dict.fromkeys(series)),
                            help="series to run; default all")
    return parser


def add_runs_folder(parser):
    parser.add_argument("--folder", type=Path, help="of the runs; default that of --output")


def runs_folder(arguments):
    return arguments.folder or arguments.output / ("runs" if arguments.update else "")


def wanted(arguments, series):
    return arguments.only is None or series in arguments.only


def processor_seconds():
    """Of the runs that have ended, on all their cores: others may use the machine at the time."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_script(arguments, script, folder, variables, templates=POTENTIALS, log="none"):
    """Runs an input script in a folder; a list gives a variable several values. Returns what
    subprocess.run does."""
    command = [arguments.lmp, "-in", script, "-log", log, "-var", "templates", templates]
    for name, value in variables.items():
        command += ["-var", name, *map(str, value if isinstance(value, list) else [value])]
    if arguments.ranks > 1:
        command = ["mpirun", "-np", str(arguments.ranks), *command]
    return subprocess.run(command, cwd=folder, check=False, capture_output=True, text=True)


def run_once(arguments, script, folder, variables):
    """Runs an input script in a folder, unless its log is there; false if it was not asked for."""
    if (folder / "log.lammps").exists():
        return True
    if not wanted(arguments, folder.name):
        return False
    folder.mkdir(parents=True, exist_ok=True)
    run_script(arguments, script, folder, variables, log="log.lammps").check_returncode()
    return True


def run_cases(arguments, path, columns, cases, run):
    """{label: rows of numbers} of all (series, label, variables) of `cases`, by run(arguments,
    variables).

    The CSV file keeps them: what it holds is not run again.
    
    """
    table = {}
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            for row in csv.DictReader(file):
                table.setdefault(row["case"], []).append([float(row[name]) for name in columns])
    for series, label, variables in cases:
        if label in table or not wanted(arguments, series):
            continue
        print(label, flush=True)
        table[label] = run(arguments, variables)
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["case", *columns])
            for name, rows in table.items():
                writer.writerows([name, *(f"{value:.8g}" for value in row)] for row in rows)
    return {label: np.array(rows) for label, rows in table.items()}


def write_rows(rows, path):
    """A CSV file of {case: {column: number}}."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", *next(iter(rows.values()))])
        for name, row in rows.items():
            writer.writerow([name, *(f"{value:.4g}" for value in row.values())])
