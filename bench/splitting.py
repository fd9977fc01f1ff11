#!/usr/bin/env python3
"""Splitting errors that `splitting` measures, splitting.csv, drawn as splitting.png."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
from rbc import command_line  # noqa: E402, F401
import matplotlib  # noqa: E402
import numpy as np  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from program_table import folder_with  # noqa: E402

CURVES = [("projection_velocity", "projection, velocity", "C0o-"),
          ("coupled_velocity", "coupled, velocity", "C0s--"),
          ("projection_pressure", "projection, pressure", "C1o-"),
          ("coupled_pressure", "coupled, pressure", "C1s--"),
          ("splitting_slip", "projection, slip at the plates", "C2^-")]


def main():
    folder = folder_with("splitting", __doc__)
    errors = np.genfromtxt(folder / "splitting.csv", delimiter=",", names=True)
    figure, axes = pyplot.subplots(figsize=(6, 4.2), layout="constrained")
    for name, label, style in CURVES:
        axes.loglog(errors["viscous_number"], errors[name], style, label=label)
    axes.set_xlabel(r"viscous Courant number $\nu\,\Delta t / h^2$")
    axes.set_ylabel("relative error")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(folder / "splitting.png", dpi=150)


if __name__ == "__main__":
    main()
