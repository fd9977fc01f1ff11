#!/usr/bin/env python3
"""Plots the errors that `splitting` prints.

usage: splitting.py splitting.csv splitting.png
"""
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

CURVES = [("projection_velocity", "projection, velocity", "C0o-"),
          ("coupled_velocity", "coupled, velocity", "C0s--"),
          ("projection_pressure", "projection, pressure", "C1o-"),
          ("coupled_pressure", "coupled, pressure", "C1s--"),
          ("splitting_slip", "projection, slip at the plates", "C2^-")]


def main(table, picture):
    errors = np.genfromtxt(table, delimiter=",", names=True)
    figure, axes = pyplot.subplots(figsize=(6, 4.2), layout="constrained")
    for name, label, style in CURVES:
        axes.loglog(errors["viscous_number"], errors[name], style, label=label)
    axes.set_xlabel(r"viscous Courant number $\nu\,\Delta t / h^2$")
    axes.set_ylabel("relative error")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(picture, dpi=150)


main(*sys.argv[1:])
