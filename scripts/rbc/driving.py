"""LAMMPS driven from Python by its own module, with this package's plugin."""
import os
import sys
from pathlib import Path

from rbc.cell_tables import cells_of_array
from rbc.errors import InputError

HOW = "scripts/python.sh sets the paths that it needs"
TOP = Path(__file__).resolve().parents[2]    # of the repository, or share/user-rbc


def plugin_folder():
    """Of the plugin that was built in the repository or installed with this file, or None."""
    for folder in (TOP / "build", TOP.parents[1] / "lib" / "user-rbc"):
        if (folder / "rbcplugin.so").exists():
            return str(folder)
    return None


def start_lammps(*words):
    """LAMMPS with the styles of USER-RBC; `words` are those of its command line.

    All MPI tasks that run the program take part, as with `mpirun -np 2`. The plugin is the one of
    LAMMPS_PLUGIN_PATH or, where that is not set, the one beside this package; templates and
    materials are those of LAMMPS_POTENTIALS in the same way. The module lammps is the one that was
    installed with this package or, in the repository, that of PYTHONPATH.
    """
    if plugin_folder():
        os.environ.setdefault("LAMMPS_PLUGIN_PATH", plugin_folder())
    os.environ.setdefault("LAMMPS_POTENTIALS", str(TOP / "potentials"))
    if (TOP / "python" / "lammps").is_dir():
        sys.path.insert(0, str(TOP / "python"))
    try:
        from lammps import lammps
        lmp = lammps(cmdargs=[str(word) for word in words])
    except ImportError as problem:
        raise InputError(f"there is no Python module lammps: {HOW}") from problem
    except OSError as problem:
        raise InputError(f"LAMMPS's library cannot be loaded: {problem}; {HOW}") from problem
    if not lmp.has_style("compute", "rbc/cell"):
        lmp.close()
        raise InputError("LAMMPS has no styles of USER-RBC: LAMMPS_PLUGIN_PATH must name the "
                         f"folder of rbcplugin.so; {HOW}")
    return lmp


def cells_now(lmp, compute="cell"):
    """All columns of a compute rbc/cell at the current step, by name. All MPI tasks must ask."""
    from lammps import LMP_STYLE_GLOBAL, LMP_TYPE_ARRAY

    array = lmp.numpy.extract_compute(compute, LMP_STYLE_GLOBAL, LMP_TYPE_ARRAY)
    return cells_of_array(lmp.extract_global("ntimestep"), array)
