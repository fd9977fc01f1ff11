#!/usr/bin/python3
"""Viscosity in each of the tables of in.tutorial, from a strain of 2 on, and their mean with its
standard error: seeds.py blood.*.dat"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import numpy as np  # noqa: E402
import rbc  # noqa: E402

means = []
for path in sys.argv[1:]:
    table = rbc.read_table(path)
    means.append(table["v_relative"][table["v_strain"] >= 2].mean())
    print(f"{path}: {means[-1]:.3f}")
error = np.std(means, ddof=1) / np.sqrt(len(means))
print(f"mean {np.mean(means):.3f} +- {error:.3f}")
