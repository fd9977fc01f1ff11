"""Tables of a run as CSV, for spreadsheets, pandas or R:

  python3 -m rbc csv cell.dat -o cell.csv         # compute rbc/cell by fix ave/time ... mode vector
  python3 -m rbc csv log.lammps -o thermo.csv     # thermo output, all runs one after the other
  python3 -m rbc csv cells.*.vtp -o shapes.csv    # measures of the surfaces of fix rbc/vtk
  python3 -m rbc csv sizes.dat -o sizes.csv       # any other table of fix ave/time or fix print

If all columns of compute rbc/cell are there, they have names instead of numbers. A file is known
by what is in it. Without --output the table is printed.
"""
import contextlib
import sys

from rbc import command_line
import numpy as np

from rbc.cell_tables import CELL_COLUMNS, read_cell_table, rows_of_history, write_rows
from rbc.errors import InputError
from rbc.snapshots import series
from rbc.tables import read_blocks, read_table
from rbc.text_files import kind_of, read_head
from rbc.thermo_log import read_log

SURFACES = ".vtp", ".pvtp"


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("files", nargs="+", help="a table, a log, or files of surfaces")
    parser.add_argument("--timestep", type=float,
                        help="adds a column with the time: steps times this")
    parser.add_argument("-o", "--output", help="CSV file to write")
    args = parser.parse_args(arguments)
    if len(args.files) > 1 and not all(name.endswith(SURFACES) for name in args.files):
        parser.error("several files must be surfaces (.vtp or .pvtp)")
    return args


def of_surfaces(files, timestep):
    """Measures of each cell of each file."""
    from rbc.shapes import shapes_of

    rows = []
    for step, name in series(files):
        for molecule, shape in shapes_of(name).items():
            rows.append([step, molecule, *shape.centre, shape.area, shape.volume,
                         shape.reduced_volume, shape.deformation, shape.inclination,
                         shape.tilt, *shape.semi_axes, *shape.axes[0], *shape.axes[2]])
    names = ("step", "molecule", "x", "y", "z", "area", "volume", "reduced_volume", "deformation",
             "inclination", "tilt", "long", "middle", "short", "long_x", "long_y", "long_z",
             "short_x", "short_y", "short_z")
    return with_time(dict(zip(names, np.transpose(rows))), timestep)


def of_blocks(path, timestep):
    """Of fix ave/time in vector mode: all columns of compute rbc/cell with their names, others as
    they are."""
    history = read_blocks(path)
    if len(history.names) == len(CELL_COLUMNS):
        cells = read_cell_table(path)
        return with_time(rows_of_history(cells.steps, cells.columns), timestep)
    rows = np.broadcast_to(np.arange(1, history.data.shape[1] + 1), history.data.shape[:2])
    columns = {"row": rows, **dict(zip(history.names, np.moveaxis(history.data, 2, 0)))}
    return with_time(rows_of_history(history.steps, columns), timestep)


def of_log(path, timestep):
    runs = read_log(path)
    names = dict.fromkeys(name for run in runs for name in run)
    columns = {name: np.concatenate([run.get(name, np.full(len(run["Step"]), np.nan))
                                     for run in runs]) for name in names}
    return with_time(columns, timestep, "Step")


def with_time(columns, timestep, step="step"):
    if timestep is None:
        return columns
    if step not in columns:
        raise InputError(f"--timestep needs a column {step}; there are {', '.join(columns)}")
    return {step: columns[step], "time": columns[step] * timestep, **columns}


def kind(path):
    """Which of the tables a text file is."""
    found = kind_of(read_head(path))
    if found in ("log", "blocks"):
        return of_log if found == "log" else of_blocks
    return lambda path, timestep: with_time(read_table(path), timestep, "TimeStep")


def main(arguments=None):
    args = parse(arguments)
    if args.files[0].endswith(SURFACES):
        columns = of_surfaces(args.files, args.timestep)
    else:
        columns = kind(args.files[0])(args.files[0], args.timestep)
    with contextlib.ExitStack() as stack:
        stream = sys.stdout
        if args.output:
            stream = stack.enter_context(open(args.output, "w", encoding="utf-8"))
        write_rows(stream, columns)
