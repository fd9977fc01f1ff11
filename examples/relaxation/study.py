#!/usr/bin/python3
"""Relaxation of a stretched red cell, for two viscosities of its membrane and two shapes in which
that is free of stress, beside the cells of Hochmuth et al. (1979).

Runs in.relaxation (5 to 10 minutes each on one core) for all cases, or those named with --case,
keeps the curves in relaxation.csv of a folder, draws relaxation.png there and prints the time
constants. With --draw only the picture and the numbers, from that table, or where there is none
from that of the repository.

study.py --output FOLDER [--case thinning] [--draw]
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

REFERENCE = HERE.parent / "reference" / "01g_relaxation_hochmuth1979.csv"
TABLE = "relaxation.csv"
LABELS = {"thinning": "healthy.material: η_m falls",
          "rounder": "the same, free of stress in a rounder shape", "600": "η_m = 600 pg/µs"}
# variables; the others are constant viscosities
CHANGED = {"thinning": {}, "rounder": dict(sheet="rbc_642_spheroid98")}


def curve(t, parameters):
    """L/W = m (1 + b e) / (1 - b e) with e = exp(-t/tc) (Hochmuth, Worthy and Evans, Biophys. J. 26
    (1979) 101)."""
    tc, end, first = parameters
    decay = (first - end) / (first + end) * np.exp(-t / tc)
    return end * (1 + decay) / (1 - decay)


def fit(t, ratio):
    """Time constant, L/W at the end and at the start, by least squares (Gauss-Newton)."""
    p = np.array([0.12, ratio[-1], ratio[0]])
    for _ in range(100):
        residual = ratio - curve(t, p)
        slopes = np.stack([(curve(t, p + h) - curve(t, p - h)) / 2e-6 for h in 1e-6 * np.eye(3)],
                          axis=1)
        step = np.linalg.lstsq(slopes, residual, rcond=None)[0]
        p += np.clip(step, -0.2 * p, 0.2 * p)
    return p


def measure(lmp, templates, case):
    changed = CHANGED.get(case, dict(surface_viscosity=case, fast_viscosity=case))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([lmp, "-in", HERE / "in.relaxation", "-log", "none", "-screen", "none",
                        "-var", "templates", templates, *(word for name, value in changed.items()
                                                          for word in ("-var", name, value))],
                       cwd=folder, check=True)
        return np.loadtxt(Path(folder) / "relaxation.dat")[:, :2].T


def read(path):
    series = {}
    with open(path, encoding="utf-8") as stream:
        for row in csv.reader(line for line in stream if line[0] not in "#c"):
            series.setdefault(row[0], []).append((float(row[1]), float(row[2])))
    return {name: np.array(points).T for name, points in series.items()}


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    parser.add_argument("--lmp", type=Path, default=HERE.parents[1] / "build" / "lmp_rbc")
    parser.add_argument("--case", action="append", choices=LABELS, help="measure this case only")
    parser.add_argument("--draw", action="store_true", help="do not run")
    options = command_line.parse(parser, HERE)
    table = options.output / TABLE
    source = command_line.kept(options.output, HERE, TABLE) if options.draw else table
    curves = read(source) if source.exists() else {}
    for case in [] if options.draw else options.case or LABELS:
        curves[case] = measure(options.lmp.resolve(), HERE.parents[1] / "potentials", case)
        with open(table, "w", encoding="utf-8") as stream:
            stream.write("case,time_s,L_over_W\n")
            stream.writelines(f"{name},{t:.6g},{ratio:.6g}\n" for name, rows in curves.items()
                              for t, ratio in zip(*rows))

    figure, axis = plt.subplots(figsize=(7, 4.8))
    times = []
    for n, (name, (t, ratio)) in enumerate(read(REFERENCE).items()):
        p = fit(t, ratio)
        times.append(p[0])
        axis.plot(t, ratio, "os^v"[n], ms=4, mfc="none", color=f"C{n}",
                  label=f"Hochmuth 1979, cell {name}: {p[0]:.3f} s")
        print(f"data, cell {name}: tc = {p[0]:.4f} s, L/W from {p[2]:.2f} to {p[1]:.2f}")
    print(f"data: {min(times):.4f} to {max(times):.4f} s")
    for n, case in enumerate(case for case in LABELS if case in curves):
        t, ratio = curves[case]
        p = fit(t, ratio)
        axis.plot(t, ratio, ("-", "--", ":")[n], color="k", lw=2 if n == 0 else 1,
                  label=f"{LABELS[case]}: {p[0]:.3f} s")
        inside = "inside" if min(times) <= p[0] <= max(times) else "outside"
        print(f"{case}: tc = {p[0]:.4f} s, L/W from {p[2]:.2f} to {p[1]:.2f}, {inside} the data")
    axis.set_xlabel("time / s")
    axis.set_ylabel("length over width")
    axis.set_xlim(0, 0.45)
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(options.output / "relaxation.png", dpi=110)


if __name__ == "__main__":
    main()
