"""Taylor deformation and orientation of cells in shear over time, with reference curves."""
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from rbc.aggregates import COLORS
from rbc.errors import InputError
from rbc.shapes import angle_to_flow
from rbc.tables import read_blocks, read_csv, read_table

MARKERS = "osD^vP"
GREYS = ("#222222", "#b06000", "#777777")
STYLES = ("-", "--", ":", "-.")


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
            raise InputError(f"no column {column} for {condition}; there are {', '.join(rows[0])}")
        rows = [row for row in rows if same(row[column], value)]
    if not rows:
        raise InputError(f"no row with {' '.join(conditions)}")
    return rows


def numbers(rows, *columns):
    """Columns of CSV rows as arrays, without the rows where one is empty."""
    missing = [column for column in columns if column not in rows[0]]
    if missing:
        raise InputError(f"no column {missing[0]}; there are {', '.join(rows[0])}")
    filled = [[row[column] for column in columns] for row in rows]
    return np.array([row for row in filled if all(row)], dtype=float).reshape(-1, len(columns)).T


def given_series(text):
    """(label, x, y) of "label=file.csv:xcol:ycol[:filtercol=value]..."."""
    label, _, source = text.partition("=")
    path, *fields = source.split(":")
    if len(fields) < 2:
        raise InputError(f"--series {text}: not label=file.csv:xcol:ycol[:filtercol=value]")
    return label, *numbers(select(read_csv(path), fields[2:]), *fields[:2])


def reference_series(path, conditions, column):
    """(label, x, y) per source of a reference file with columns source, gdot_t and `column`."""
    rows = select(read_csv(path), conditions)
    for source in dict.fromkeys(row["source"] for row in rows):
        chosen = [row for row in rows if row["source"] == source]
        yield source, *numbers(chosen, "gdot_t", column)


def cell_lines(path, factor=1.0, molecules=None, label="this run"):
    """Lists of (label, x, y) for D and for the angles of cells, from a file of compute rbc/cell. x
    is the step times the factor."""
    history = read_blocks(path)
    x = history.steps * factor
    identity = history.column(1)[0].astype(int)
    chosen = [i for i, m in enumerate(identity) if not molecules or m in molecules]
    if not chosen:
        raise InputError(f"none of the molecules {molecules} is in {path}")
    deformation = history.column(7)
    angles = [("long axis", angle_to_flow(history.columns(11, 13))),
              ("short axis", angle_to_flow(history.columns(14, 16)))]
    return ([(f"cell {identity[i]}" if len(chosen) > 1 else label, x, deformation[:, i])
             for i in chosen],
            [(kind, x, angle[:, i]) for kind, angle in angles for i in chosen])


def names_of(paths):
    """Of files for a legend: without the folder where that tells them apart."""
    stems = [Path(path).stem for path in paths]
    return stems if len(set(stems)) == len(stems) else [str(path) for path in paths]


def compared_lines(paths, factors, molecules=None):
    """As cell_lines, of several files, a line for each: the mean of its cells, and the angles where
    all files have one cell."""
    shapes, angles, single = [], [], True
    for name, path, factor in zip(names_of(paths), paths, factors):
        found, turned = cell_lines(path, factor, molecules)
        single = single and len(found) == 1
        label = name if len(found) == 1 else f"{name}, mean of {len(found)} cells"
        shapes.append((label, found[0][1], np.mean([y for _, _, y in found], axis=0)))
        angles.append(turned)
    # by kind, each with all files
    return shapes, [line for kind in zip(*angles) for line in kind] if single else []


def table_lines(path, x="time", y=("D",), angles=(), factor=1.0):
    """As cell_lines, from columns of a table; those that start with theta are angles, too."""
    table = read_table(path)
    missing = [name for name in [x, *y, *angles] if name not in table]
    if missing:
        raise InputError(f"no column {missing[0]} in {path}, which has {' '.join(table)}")
    along = table[x] * factor
    angles = angles or [name for name in table if name.startswith("theta")]
    return ([(name, along, table[name]) for name in y],
            [(name.replace("theta_", "") + (" axis" if name.startswith("theta_") else ""),
              along, table[name]) for name in angles if name not in y])


def spaced(source):
    """"Doddi&Bagchi2008" -> "Doddi & Bagchi 2008"."""
    return re.sub(r"(?<=\w)&(?=\w)", " & ", re.sub(r"(?<=[a-z])(?=\d)|(?<=\w)(?=\()", " ", source))


class ShearLabels(NamedTuple):
    """Of the axes, and of the whole."""
    x: str = "time"
    y: str = "Taylor deformation D"
    title: str = ""


def draw_shapes(axes, shapes, references):
    """Lines of the shapes, with their mean where they are many, and points of the references."""
    few = len(shapes) <= len(COLORS)
    for i, (label, x, y) in enumerate(shapes):
        axes.plot(x, y, color=color_of(i, few), lw=1.8 if few else 0.6,
                  label=label if few else None)
    if not few:
        axes.plot(shapes[0][1], np.mean([y for _, _, y in shapes], axis=0), lw=2.2,
                  color=COLORS[0], label=f"mean of {len(shapes)}")
    end = max(x[-1] for _, x, _ in shapes)
    for i, (label, x, y) in enumerate(references):
        axes.plot(x[x <= end], y[x <= end], ls="none", marker=MARKERS[i % len(MARKERS)],
                  ms=5, mfc="none", mec=GREYS[i % len(GREYS)], label=spaced(label), zorder=5)
    axes.set_xlim(left=min(x[0] for _, x, _ in shapes), right=end)
    if len(shapes) + len(references) > 1:
        axes.legend()


def color_of(line, few):
    return COLORS[line % len(COLORS)] if few else "#9db3c8"


def draw_angles(axes, angles, count):
    """Lines of the angles of `count` cells."""
    few = count <= len(COLORS)
    kinds = list(dict.fromkeys(label for label, _, _ in angles))
    for i, (label, x, y) in enumerate(angles):
        axes.plot(x, unwrapped_gaps(y), color=color_of(i % count, few),
                  ls=STYLES[kinds.index(label) % len(STYLES)], lw=1.4 if few else 0.5)
    for kind, style in zip(kinds, STYLES):
        axes.plot([], [], color="#444444", ls=style, lw=1.4, label=kind)
    axes.set(ylabel="angle to the flow (degrees)", ylim=(-92, 92), yticks=(-90, -45, 0, 45, 90))
    axes.legend(loc="lower right", ncols=len(kinds), bbox_to_anchor=(1, 0.98), borderaxespad=0)


def plot_shear(output, shapes, angles=(), references=(), labels=ShearLabels(), dpi=150):
    """A picture of lists of (label, x, y): lines of the shapes, below them those of the angles."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    count = 2 if angles else 1
    with rc_context({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
                     "axes.grid": True, "grid.color": "#e6e6e6", "axes.axisbelow": True,
                     "legend.frameon": False, "legend.fontsize": 9}):
        figure = Figure(figsize=(6.4, 4.2 if count == 1 else 6.4), layout="constrained")
        panels = figure.subplots(count, 1, sharex=True, squeeze=False,
                                 gridspec_kw={"height_ratios": [3, 2][:count]})[:, 0]
        draw_shapes(panels[0], shapes, references)
        panels[0].set_ylabel(labels.y)
        if labels.y == ShearLabels().y:
            panels[0].set_ylim(bottom=0)
        if angles:
            draw_angles(panels[1], angles, len(shapes))
        panels[-1].set_xlabel(labels.x)
        panels[0].set_title(labels.title, loc="left")
        figure.savefig(output, dpi=dpi)
