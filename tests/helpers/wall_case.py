"""Walls of atoms in a fluid: planes, tubes and spheres of them, and scripts with fix rbc/wall."""

import numpy as np

from lammps_case import attempt, run, scene

VISCOSITY = 1.2
OFFSET = 0.3810    # of a plane of markers with peskin4, mean over its places, in cells


def data_file(box, *walls):
    """Atoms of type 2, 3, ... for each wall; cells are of type 1."""
    atoms = [(kind, *x) for kind, wall in enumerate(walls, 2) for x in wall]
    lines = [f"{n} 0 {kind} {x!r} {y!r} {z!r}" for n, (kind, x, y, z) in enumerate(atoms, 1)]
    sides = [f"0 {side} {name}lo {name}hi" for side, name in zip(box, "xyz")]
    return "\n".join(["walls", "", f"{len(atoms)} atoms", f"{1 + len(walls)} atom types",
                      "1 angle types", "", *sides, "", "Atoms # molecular", "", *lines, ""])


def plane(box, z):
    return [(i + 0.1, j + 0.7, z) for i in range(box[0]) for j in range(box[1])]


def tube(box, radius, spacing=1.2):
    rings, around = 2 * round(box[0] / (2 * spacing)), round(2 * np.pi * radius / spacing)
    return [(box[0] * (ring + 0.3) / rings, float(box[1] / 2 + radius * np.cos(angle)),
             float(box[2] / 2 + radius * np.sin(angle)))
            for ring in range(rings)
            for angle in 2 * np.pi * (np.arange(around) + 0.5 * (ring % 2)) / around]


def sphere(centre, radius, spacing=1.2):
    count = round(4 * np.pi * radius**2 / spacing**2)
    z = 1 - (2 * np.arange(count) + 1) / count
    angle, across = np.pi * (3 - 5**0.5) * np.arange(count), np.sqrt(1 - z * z)
    return (np.array(centre) +
            radius * np.array([across * np.cos(angle), across * np.sin(angle), z]).T).tolist()


COLUMNS = [f"f_w[{n}]" for n in range(1, 10)] + [f"f_flow[{n}]" for n in (1, 7, 8, 10, 12)]
BASE = dict(units="units micro", newton="", style="atom_style molecular",
            boundary="boundary p p p", processors="", data="read_data walls.data",
            mass="mass * 1.0", neighbor="neighbor 1.0 bin", comm="comm_modify cutoff 12",
            pair="pair_style zero 2.0\npair_coeff * *", groups="group w type 2", before="",
            fluid=f"fix flow all rbc/fluid dx 1.0 viscosity {VISCOSITY} density 1.0", drive="",
            wall="fix w w rbc/wall flow kernel peskin4", ib="",
            thermo="thermo_style custom step " + " ".join(COLUMNS),
            thermo_modify="thermo_modify format float %.15g", every="thermo 1",
            timestep="timestep 100", dump="", run="run 0")
PLATES = dict(boundary="boundary p p f")
AT_REST = "wall zlo 0 0 0 wall zhi 0 0 0"


def script(drive="", wall="", **changes):
    lines = dict(BASE, **changes)
    lines["fluid"] += " " + drive
    lines["wall"] += " " + wall
    del lines["drive"]
    return scene(lines)


def walls(box, *surfaces, drive="", wall="", ranks=1, tries=False, **changes):
    files = {"walls.data": data_file(box, *surfaces)}
    return (attempt if tries else run)(script(drive, wall, **changes), ranks, files=files)
