"""Runs the input script of an example as a user does, with some of its variables set; reads its
study.py."""

import importlib.util
import re

import numpy as np

from lammps_case import POTENTIALS, ROOT, dump_line, read_template, run


def example_script(name, **variables):
    """Variables are those of the script's `variable ... index` lines; a string may hold a list of
    values."""
    lines = [f"variable {variable} index {value}" for variable, value in variables.items()]
    script = (ROOT / "examples" / name / f"in.{name}").read_text()
    return "\n".join([f"variable templates index {POTENTIALS}", *lines, script])


def run_example(name, ranks=1, timeout=500, **variables):
    return run(example_script(name, **variables), ranks, timeout=timeout)


def shortened(script, group, steps, every):
    """The script with its long run cut to some steps, and atoms of the group dumped in it."""
    dump = dump_line(every, columns="id xu yu zu").replace("dump atoms all", f"dump atoms {group}")
    script, runs = re.subn(r"^run +(\d{5,}|\$\{steps\})$", f"{dump}\nrun {steps}", script,
                           flags=re.MULTILINE)
    if runs != 1:
        raise ValueError(f"the script has {runs} long runs")
    return script


def study_of(name):
    """The study.py of an example as a module: its closed forms, references and readers."""
    specification = importlib.util.spec_from_file_location(f"study_{name}",
                                                           ROOT / "examples" / name / "study.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def polyhedron(shape):
    """Area, volume and mean distance of the vertices from the centre of a template."""
    x, triangles = read_template(POTENTIALS / f"{shape}.mol")
    corners = x[triangles]
    twice_area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return (np.linalg.norm(twice_area, axis=1).sum() / 2,
            np.einsum("ij,ij->", corners[:, 0], twice_area) / 6,
            np.linalg.norm(x, axis=1).mean())
