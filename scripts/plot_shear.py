#!/usr/bin/python3
"""Draw the Taylor deformation D(t) and the orientation of cells in shear, with reference curves.

Input is either the array of `compute rbc/cell` (all columns, or 1, 7 and 11 to 16 in any order),

  fix out all ave/time 100 1 100 c_cell[*] mode vector file cell.dat
  plot_shear.py --cells cell.dat --timestep 2 --shear-rate 1e-3 \\
                --reference 02b_capsule_shear_NH_transient_D.csv --case Ca_E=0.1 --output D.png

or a whitespace table with a line "# time D theta_long area" above it:

  plot_shear.py table.dat --x time --y D --xscale 1e-3 \\
                --series "theory=curve.csv:time:D:Ca=0.1" --output D.png

The flow is along x and its gradient along z. Angles are those of the projection on the x-z plane
to x, in degrees in (-90, 90]: of the long axis, and of the short axis (a disc's normal).
"""
import re

import command_line
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from read_ave_time import read_ave_time, read_csv, read_table

COLORS = ("#1f4e79", "#b3202a", "#2e7d4f", "#8a5a00", "#6a3d9a", "#00798c")
MARKERS = "osD^vP"
GREYS = ("#222222", "#b06000", "#777777")
STYLES = ("-", "--", ":", "-.")


def angle_to_flow(axis):
    """Angle in degrees in (-90, 90] to x of axes (..., 3) projected on the x-z plane."""
    angle = np.degrees(np.arctan2(axis[..., 2], axis[..., 0]))
    return 90 - (90 - angle) % 180


def unwrapped_gaps(angle):
    """Copy with NaN where the angle jumps from one end of (-90, 90] to the other."""
    shown = angle.copy()
    shown[1:][np.abs(np.diff(angle)) > 90] = np.nan
    return shown


def same(text, value):
    """True when two fields are equal as numbers or as text."""
    try:
        return float(text) == float(value)
    except ValueError:
        return text == value


def select(rows, conditions):
    """Rows that satisfy every "column=value"."""
    for condition in conditions:
        column, _, value = condition.partition("=")
        if rows and column not in rows[0]:
            raise SystemExit(f"no column {column} for {condition}; there are {', '.join(rows[0])}")
        rows = [row for row in rows if same(row[column], value)]
    if not rows:
        raise SystemExit(f"no row with {' '.join(conditions)}")
    return rows


def numbers(rows, *columns):
    """Columns of CSV rows as arrays, without the rows where one is empty."""
    missing = [column for column in columns if column not in rows[0]]
    if missing:
        raise SystemExit(f"no column {missing[0]}; there are {', '.join(rows[0])}")
    filled = [[row[column] for column in columns] for row in rows]
    return np.array([row for row in filled if all(row)], dtype=float).reshape(-1, len(columns)).T


def given_series(text):
    """(label, x, y) of "label=file.csv:xcol:ycol[:filtercol=value]..."."""
    label, _, source = text.partition("=")
    path, *fields = source.split(":")
    if len(fields) < 2:
        raise SystemExit(f"--series {text}: not label=file.csv:xcol:ycol[:filtercol=value]")
    return label, *numbers(select(read_csv(path), fields[2:]), *fields[:2])


def reference_series(path, conditions, column):
    """(label, x, y) per source of a reference file with columns source, gdot_t and `column`."""
    rows = select(read_csv(path), conditions)
    for source in dict.fromkeys(row["source"] for row in rows):
        chosen = [row for row in rows if row["source"] == source]
        yield source, *numbers(chosen, "gdot_t", column)


def cell_lines(args):
    """x label, then (label, x, y) lists for D and for the angles, from compute rbc/cell."""
    history = read_ave_time(args.cells)
    time = history.steps * args.timestep * args.xscale * (args.shear_rate or 1)
    identity = history.column(1)[0].astype(int)
    chosen = [i for i, m in enumerate(identity) if not args.molecules or m in args.molecules]
    if not chosen:
        raise SystemExit(f"none of the molecules {args.molecules} is in {args.cells}")
    deformation = history.column(7)
    angles = [("long axis", angle_to_flow(history.columns(11, 13))),
              ("short axis", angle_to_flow(history.columns(14, 16)))]
    return (r"$\dot\gamma\,t$" if args.shear_rate else "time",
            [(f"cell {identity[i]}" if len(chosen) > 1 else args.label, time, deformation[:, i])
             for i in chosen],
            [(kind, time, angle[:, i]) for kind, angle in angles for i in chosen])


def table_lines(args):
    """As cell_lines, from a table; columns that start with theta are angles."""
    table = read_table(args.table)
    wanted = args.y + args.angles
    missing = [name for name in [args.x] + wanted if name not in table]
    if missing:
        raise SystemExit(f"no column {missing[0]} in {args.table}, which has {' '.join(table)}")
    x = table[args.x] * args.xscale
    angles = args.angles or [name for name in table if name.startswith("theta")]
    return (args.x, [(name, x, table[name]) for name in args.y],
            [(name.replace("theta_", "") + (" axis" if name.startswith("theta_") else ""),
              x, table[name]) for name in angles if name not in args.y])


def spaced(source):
    """"Doddi&Bagchi2008" -> "Doddi & Bagchi 2008"."""
    return re.sub(r"(?<=\w)&(?=\w)", " & ", re.sub(r"(?<=[a-z])(?=\d)|(?<=\w)(?=\()", " ", source))


def draw(args, xlabel, shapes, angles, references):
    """Draw the panels and save the figure."""
    plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
                         "axes.grid": True, "grid.color": "#e6e6e6", "axes.axisbelow": True,
                         "legend.frameon": False, "legend.fontsize": 9})
    count = 2 if angles else 1
    figure, panels = plt.subplots(count, 1, sharex=True, squeeze=False, layout="constrained",
                                  figsize=(6.4, 4.2 if count == 1 else 6.4),
                                  gridspec_kw={"height_ratios": [3, 2][:count]})
    panels = panels[:, 0]
    few = len(shapes) <= len(COLORS)

    def color(i):
        return COLORS[i % len(COLORS)] if few else "#9db3c8"

    for i, (label, x, y) in enumerate(shapes):
        panels[0].plot(x, y, color=color(i), lw=1.8 if few else 0.6, label=label if few else None)
    if not few:
        panels[0].plot(shapes[0][1], np.mean([y for _, _, y in shapes], axis=0), lw=2.2,
                       color=COLORS[0], label=f"mean of {len(shapes)}")
    end = max(x[-1] for _, x, _ in shapes)
    for i, (label, x, y) in enumerate(references):
        panels[0].plot(x[x <= end], y[x <= end], ls="none", marker=MARKERS[i % len(MARKERS)],
                       ms=5, mfc="none", mec=GREYS[i % len(GREYS)], label=spaced(label), zorder=5)
    panels[0].set_ylabel("Taylor deformation D" if args.y == ["D"] else ", ".join(args.y))
    if args.y == ["D"]:
        panels[0].set_ylim(bottom=0)
    kinds = list(dict.fromkeys(label for label, _, _ in angles))
    for i, (label, x, y) in enumerate(angles):
        panels[1].plot(x, unwrapped_gaps(y), color=color(i % len(shapes)),
                       ls=STYLES[kinds.index(label) % len(STYLES)], lw=1.4 if few else 0.5)
    for kind, style in zip(kinds, STYLES):
        panels[1].plot([], [], color="#444444", ls=style, lw=1.4, label=kind)
    if angles:
        panels[1].set(ylabel="angle to the flow (degrees)", ylim=(-92, 92),
                      yticks=(-90, -45, 0, 45, 90))
        panels[1].legend(loc="lower right", ncols=len(kinds), bbox_to_anchor=(1, 0.98),
                         borderaxespad=0)
    panels[-1].set_xlabel(args.xlabel or xlabel)
    panels[-1].set_xlim(left=min(x[0] for _, x, _ in shapes), right=end)
    panels[0].set_title(args.title, loc="left")
    if len(shapes) + len(references) > 1:
        panels[0].legend()
    figure.savefig(args.output, dpi=args.dpi)


def parse(arguments):
    parser = command_line.parser(__doc__)
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("table", nargs="?", help="whitespace table with a '# name ...' line")
    source.add_argument("--cells", metavar="FILE", help="fix ave/time file of compute rbc/cell")
    parser.add_argument("--timestep", type=float, default=1.0, help="time per step (default 1)")
    parser.add_argument("--shear-rate", type=float, metavar="G", help="draw against G t")
    parser.add_argument("--molecules", type=int, nargs="+", metavar="ID", help="only these cells")
    parser.add_argument("--x", default="time", help="column of the table (default time)")
    parser.add_argument("--y", nargs="+", default=["D"], help="columns of the table (default D)")
    parser.add_argument("--angles", nargs="+", default=[], metavar="COL",
                        help="columns of the table that are angles (default: those named theta*)")
    parser.add_argument("--xscale", type=float, default=1.0, help="factor for x")
    parser.add_argument("--series", action="append", default=[],
                        metavar="label=file.csv:xcol:ycol[:col=value]", help="extra points")
    parser.add_argument("--reference", metavar="CSV",
                        help="file with columns source, gdot_t and D: one series per source")
    parser.add_argument("--case", action="append", default=[], metavar="COL=VALUE",
                        help="rows of --reference to draw")
    parser.add_argument("--xlabel")
    parser.add_argument("--label", default="this run", help="name of a single cell's line")
    parser.add_argument("--title", default="")
    parser.add_argument("--dpi", type=int, default=150)
    parser.add_argument("-o", "--output", required=True, help="picture to write")
    return parser.parse_args(arguments)


def main(arguments=None):
    args = parse(arguments)
    lines = cell_lines(args) if args.cells else table_lines(args)
    references = [given_series(text) for text in args.series]
    if args.reference:
        references += reference_series(args.reference, args.case, args.y[0])
    draw(args, *lines, references)


if __name__ == "__main__":
    main()
