"""What examples of dense blood share: how viscous it is, and at what cost."""
import tempfile
from pathlib import Path

import example_study
from rbc.tables import read_table

COLUMNS = "viscosity", "core_seconds"


def mean_viscosity(table, strain, start, end=float("inf")):
    """Mean viscosity over that of plasma from one share of the strain to another, of blood.dat."""
    share = table["v_sheared"] / strain
    return table["v_relative"][(share > start) & (share <= end)].mean()


def settled(table, strain):
    """Mean viscosity over that of plasma in the last two fifths of the strain, of blood.dat."""
    return mean_viscosity(table, strain, 0.6)


def run_blood(arguments, script, variables, templates=example_study.POTENTIALS):
    """blood.dat of a run and its seconds of processors; None instead of a table if it stopped."""
    with tempfile.TemporaryDirectory() as folder:
        before = example_study.processor_seconds()
        done = example_study.run_script(arguments, script, folder, variables, templates)
        seconds = example_study.processor_seconds() - before
        if done.returncode:
            print(done.stdout[-2000:])
            return None, seconds
        return read_table(Path(folder) / "blood.dat"), seconds


def measure_viscosity(arguments, script, variables, templates=example_study.POTENTIALS):
    """A row of COLUMNS; NaN for the viscosity of a run that stopped. `variables` has the strain."""
    table, seconds = run_blood(arguments, script, variables, templates)
    return [[float("nan") if table is None else settled(table, variables["strain"]), seconds]]
