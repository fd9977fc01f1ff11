"""The decks that are mutated: the examples in small boxes, with coarse cells, cut to two steps.

A deck is a dictionary of the texts of its files; `in.deck` is its script. A vessel is a prism of
few triangles, so that a mutation of its STL file hits something.
"""

import math
import re
import struct
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory

from lammps_case import POTENTIALS, ROOT, make_template

SCRIPT = "in.deck"
STEPS = 2

CELL = dict(shape="rbc_162", dx=1.0)
# tables of distances of a finer cell would take most of the time
PACKED = dict(shape="rbc_42", dx=1.0)
CAPSULE = dict(shape="capsule_162")
SMALL_BLOOD = dict(PACKED, hematocrit=0.15, error=1e-2)

# What makes each example small, in its own variables.
EXAMPLES = {
    "balloon": dict(CAPSULE, dx=0.5, box=5),
    "blood": dict(PACKED, length=10, gap=10, hematocrit=0.2, every=1, frames=1),
    "blood-tube": dict(PACKED, tube=12, length=10, hematocrit=0.15, adhesion=2e-4, every=1,
                       frames=1),
    "capsule-channel": dict(CAPSULE, cells=5, length=4, ratio=0.6),
    "capsule-shear": dict(CAPSULE, dx=0.5, length=4, gap=4),
    "cell-statistics": dict(PACKED, cells=2),
    "contrast": dict(CAPSULE, dx=0.5, length=4, gap=4),
    "doublet": dict(CELL),
    "fahraeus": dict(SMALL_BLOOD, diameter=10, length=10),
    "relaxation": dict(CELL),
    "rouleau": dict(CELL, cells=2),
    "settling-sphere": dict(cells=12),
    "shear-cell": dict(CELL),
    "stiff": dict(CELL, box=12),
    "stretch": dict(CELL, length=16, width=12, patch=3.5),
    "suspension": dict(PACKED, cells=2, hematocrit=0.1, gap=12),
    "suspension-shear": dict(PACKED, cells=3),
    "tank-treading": dict(CELL, height=12, width=12),
    "throat": dict(SMALL_BLOOD, length=2, width=1.5, throat=1.2),
    "tube-poiseuille": dict(SMALL_BLOOD, diameter=10, length=10),
}

MATERIALS = {"capsule-shear": "capsule", "contrast": "capsule", "stiff": "paper-table2"}

# Examples with parts to choose from: their folder, and the conditions of jumps that are true.
PARTS = {
    "blood": ("blood", ["${tube} == 0"]),
    "blood-tube": ("blood", ["${tube} > 0"]),
}

# What the examples do not use.
FURTHER = """\
units           micro
atom_style      molecular
boundary        p p p
region          box block 0 12 0 12 0 12
create_box      2 box angle/types 1
molecule        rbc cell.mol
region          vessel rbc/mesh vessel.stl
rbc/create      rbc number 1 seed 5 region vessel type 1
rbc/surface     vessel type 2 spacing 1.0
group           cells type 1
group           wall type 2
mass            * 0.5
neighbor        1.0 bin
comm_modify     cutoff 6.0
fix             membrane cells rbc/membrane rbc skalak 0.005 1.0 bending 2.0e-4 5 volume yes \
viscosity 100 thinning 10 1e-5
fix             flow all rbc/fluid dx 1.0 viscosity 1.5 density 1.025 \
inside vessel mean x 1e-4
fix             ib cells rbc/ib flow kernel peskin4 integrator ab2
fix             wall wall rbc/wall flow kernel peskin4 tol 1e-3
compute         cell cells rbc/cell
compute         agg cells rbc/aggregate 0.5
fix             surfaces cells rbc/vtk 1 cells.*.pvtp unwrap yes aggregate agg
fix             out all ave/time 1 1 1 c_cell[*] mode vector file cell.dat
dump            flow all grid 1 flow.*.grid f_flow:grid:velocity[1] f_flow:grid:pressure
restart         1 r1.restart r2.restart
thermo_style    custom step pe f_membrane f_flow[1] f_flow[12] f_wall[7] f_ib[5] c_agg[1]
thermo          1
timestep        50
balance         1.1 shift xyz 5 1.1
run             2
change_box      all x scale 1.0
run             2
"""


def prism(lo=-0.0, length=12.0, centre=(6.0, 6.0), radius=5.0, sides=8, layers=3):
    """Corners of the triangles of a tube along x, open at both ends."""
    def corner(layer, side):
        angle = 2 * math.pi * (side + 0.5) / sides
        return (lo + length * layer / layers, centre[0] + radius * math.cos(angle),
                centre[1] + radius * math.sin(angle))

    triangles = []
    for layer in range(layers):
        for side in range(sides):
            a, b = corner(layer, side), corner(layer, side + 1)
            c, d = corner(layer + 1, side), corner(layer + 1, side + 1)
            triangles += [(a, b, c), (b, d, c)]
    return triangles


def stl_text(triangles):
    facets = ["facet normal 0 0 0\nouter loop\n" +
              "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*corner) for corner in triangle) +
              "endloop\nendfacet\n" for triangle in triangles]
    return ("solid vessel\n" + "".join(facets) + "endsolid vessel\n").encode()


def stl_binary(triangles):
    largest = 3e38    # of the numbers in the file
    records = [struct.pack("<12fH", 0, 0, 0, *(max(-largest, min(x, largest)) for corner in triangle
                                               for x in corner), 0)
               for triangle in triangles]
    return b"vessel".ljust(80) + struct.pack("<I", len(triangles)) + b"".join(records)


@lru_cache
def _template(shape):
    """The text of a template of potentials/, or of a coarse cell like them."""
    if shape != "rbc_42":
        return (POTENTIALS / f"{shape}.mol").read_text()
    with TemporaryDirectory() as folder:
        output = Path(folder) / "cell.mol"
        make_template("disc", "--diameter", 7.82, "--frequency", 2, "--output", output)
        return output.read_text()


def _joined(script, conditions=None):
    """The script without continued lines, comments, loops, and commands of the shell. With
    conditions, which may be none, jumps are followed."""
    script = re.sub(r"&[ \t]*\n[ \t]*", "", script)
    lines = [re.sub(r"(^|\s)#.*", "", line).rstrip() for line in script.splitlines()]
    if conditions is not None:
        lines = _followed(lines, conditions)
    return [line for line in lines if line and
            not re.match(r"(jump|next|label|quit|shell)\b|if .* jump|if .*\"jump", line)]


def _followed(lines, conditions):
    """The lines that are left by jumps to labels below, if these conditions are true."""
    left, label = [], None
    for line in lines:
        if label is None:
            left.append(line)
        elif line.split()[:2] == ["label", label]:
            label = None
        jump = re.match(r'(?:if "(.*?)" then ")?jump\s+SELF\s+(\w+)', line)
        if label is None and jump and jump.group(1) in [None, *conditions]:
            label = jump.group(2)
    return left


def _without_variables(line):
    """Files lie beside the script."""
    line = re.sub(r"\$\{templates\}/(\$\{shape\}|\$\{sheet\}|\w+)\.mol", "cell.mol", line)
    line = line.replace("${templates}/dense.blood", "dense.blood")
    return re.sub(r"\$\{templates\}/(\$\{material\}|\w+)\.material", "cell.material", line)


def _example(name, variables):
    folder, conditions = PARTS.get(name, (name, None))
    script = (ROOT / "examples" / folder / f"in.{folder}").read_text()
    lines = [_without_variables(line) for line in _joined(script, conditions)]
    vessel = any("make_vessel" in line for line in lines)
    lines = ["region vessel rbc/mesh vessel.stl" if "make_vessel" in line else line
             for line in lines]
    settings = [f"variable {variable} index {value}" for variable, value in variables.items()]
    shape = variables.get("shape", "capsule_162")
    material = MATERIALS.get(name, "healthy")
    files = {SCRIPT: "\n".join(settings + lines) + "\n",
             "cell.mol": _template(shape),
             "cell.material": (POTENTIALS / f"{material}.material").read_text()}
    if "dense.blood" in files[SCRIPT]:
        dense = (POTENTIALS / "dense.blood").read_text()
        files["dense.blood"] = "\n".join(_joined(dense)) + "\n"
    files = {file: text.encode() for file, text in files.items()}
    if vessel:
        files["vessel.stl"] = stl_text(prism(0, 16, (0, 0), 5.5))
    return files


def bases():
    """Name -> files of each deck."""
    decks = {name: _example(name, variables) for name, variables in EXAMPLES.items()}
    cell = _template("rbc_42").encode()
    unsteady = FURTHER.replace("inside vessel mean x 1e-4", "inertia unsteady scheme projection")
    unsteady = unsteady.replace("f_wall[7]", "").replace("ab2", "midpoint")\
        .replace("viscosity 100 thinning 10 1e-5", "").replace("fix             wall", "#")
    for name, script, file in (("further", FURTHER, stl_text(prism())),
                               ("unsteady", unsteady, stl_binary(prism()))):
        decks[name] = {SCRIPT: script.encode(), "cell.mol": cell, "vessel.stl": file}
    return {name: {**deck, SCRIPT: shorten(deck[SCRIPT])} for name, deck in decks.items()}


def shorten(script):
    """The script with all of its runs cut short, also those of a mutated script; bytes."""
    text = script.decode("latin-1")
    text = re.sub(r"^(\s*run\s+)(\$\S+|\d{2,}|[4-9])(?=\s|$)", rf"\g<1>{STEPS}", text,
                  flags=re.MULTILINE)
    text = re.sub(r'"run [^"]*"', f'"run {STEPS}"', text)
    return text.encode("latin-1")
