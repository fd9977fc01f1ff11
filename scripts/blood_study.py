"""What examples of dense blood share: how viscous it is, and at what cost."""
import tempfile
from pathlib import Path

import example_study
from read_ave_time import read_table

COLUMNS = "viscosity", "core_seconds"


def settled(table, strain):
    """Mean viscosity over that of plasma in the last two fifths of the strain, of blood.dat."""
    return table["v_relative"][table["v_sheared"] > 0.6 * strain].mean()


def measure_viscosity(arguments, script, variables, templates=example_study.POTENTIALS):
    """A row of COLUMNS; NaN for the viscosity of a run that stopped. `variables` has the strain."""
    with tempfile.TemporaryDirectory() as folder:
        before = example_study.processor_seconds()
        done = example_study.run_script(arguments, script, folder, variables, templates)
        seconds = example_study.processor_seconds() - before
        table = read_table(Path(folder) / "blood.dat")
    if done.returncode:
        print(done.stdout[-2000:])
    return [[float("nan") if done.returncode else settled(table, variables["strain"]), seconds]]
