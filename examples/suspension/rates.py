#!/usr/bin/python3
"""Viscosity of blood of 45 % sheared at 1 to 124 /s, of cells that only repel each other and of
cells that adhere at several strengths, beside measurements. Runs in.suspension with 32 cells over a
strain of 5 for each case; writes rates.csv and rates.png to a folder and prints the tables of the
README.

rates.py --output FOLDER [--lmp ../../build/lmp_rbc] [--ranks 1] [--only inside healthy strengths]

--only names cells: inside, five times as viscous as plasma; healthy, with viscous membranes, too;
strengths: the first of them with other works of adhesion.
"""
import itertools
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from blood_study import mean_viscosity, run_blood, settled  # noqa: E402
from healthy import KINDS, PLASMA, REFERENCE, WORDS, measured  # noqa: E402
from rbc.tables import read_csv  # noqa: E402
from study import SMALL_BOX, VOLUMES  # noqa: E402

COLUMNS = "viscosity", "before", "core_seconds"
GRID = {"shape": "rbc_162", "volume": VOLUMES["rbc_162"], "dx": 0.65}
LONGEST = 10000                                  # timestep at most, us: not what limits it
RATES = 1, 3, 12.5, 62, 124                      # 1/s
ADHESION = 2.0e-4                                # work of adhesion, mJ/m^2
STRENGTHS = 0, 0.5e-4, 1.0e-4, ADHESION, 4.0e-4, 1.6e-3
SLOW = {1: STRENGTHS[:-1], 12.5: STRENGTHS}      # at 1 /s the strongest takes steps too short
MARKS = {"plasma": "k^", "albumin": "kv"}
SOURCES = {"plasma": "Chien 1970, in plasma", "albumin": "Chien 1970, in albumin-Ringer"}
COLORS = {"inside": "#1c4587", "healthy": "#8b1a1a"}


def label(kind, sigma, rate):
    return f"{kind} {sigma:g} {rate:g}"


def cases():
    """(series, label, variables) of all runs."""
    def case(series, kind, sigma, rate):
        return series, label(kind, sigma, rate), {
            **SMALL_BOX, **GRID, **KINDS[kind], "sigma": sigma, "rate": rate, "hematocrit": 0.45,
            "longest": LONGEST}

    for kind, rate, sigma in itertools.product(COLORS, RATES[::-1], (0, ADHESION)):
        yield case(kind, kind, sigma, rate)
    for rate in sorted(SLOW, reverse=True):
        for sigma in SLOW[rate][::-1]:
            yield case("strengths", "inside", sigma, rate)


def measure(arguments, variables):
    """A row of COLUMNS: `before` is the mean over the fifth of the strain before `viscosity`'s."""
    table, seconds = run_blood(arguments, HERE / "in.suspension", variables)
    strain = variables["strain"]
    means = [np.nan] * 2 if table is None else [settled(table, strain),
                                                 mean_viscosity(table, strain, 0.4, 0.6)]
    return [[*means, seconds]]


def chien(medium):
    """(shear rate, viscosity over that of the medium) at 45 %."""
    rows = [row for row in read_csv(HERE / "chien.csv") if row["medium"] == medium]
    return np.array([[float(row["shear_rate_1_s"]), float(row["viscosity_mPa_s"]) / PLASMA]
                     for row in rows]).T


def wells_merrill(percent, low=33, high=57):
    """(shear rate, viscosity over that of plasma) between Wells and Merrill's (1962) curves at two
    hematocrits, exponential in the hematocrit."""
    rows = read_csv(REFERENCE)
    rates, viscosities = [np.array([[float(row[column]) for row in rows
                                     if float(row["hematocrit_pct"]) == chosen]
                                    for chosen in (low, high)])
                          for column in ("shear_rate_1_s", "viscosity_cP")]
    share = (percent - low) / (high - low)
    return np.array([rates.mean(axis=0),
                     viscosities[0]**(1 - share) * viscosities[1]**share / PLASMA])


def cho_kensey(rate):
    """Viscosity of blood over that of plasma, fitted to measurements by Cho and
    Kensey, Biorheology 28, 241 (1991)."""
    lowest, highest, time, sharpness, power = 3.45, 56, 1.902, 1.25, 0.22    # mPa s, s
    fall = (1 + (time * rate)**sharpness)**((power - 1) / sharpness)
    return (lowest + (highest - lowest) * fall) / PLASMA


def interpolated(rate, points):
    """Both logarithmic; NaN where it was not measured."""
    if not points[0][0] / 1.01 <= rate <= 1.01 * points[0][-1]:
        return np.nan
    return np.exp(np.interp(np.log(rate), *np.log(points)))


def at(rate, points):
    value = interpolated(rate, points)
    return "–" if np.isnan(value) else f"{value:.1f}"


def off(table, key, medium, rate):
    """By how much a run is off Chien's measurement."""
    if key not in table:
        return "–"
    return f"{100 * (table[key][-1][0] / interpolated(rate, chien(medium)) - 1):+.0f} %"


def cell(table, key):
    if key not in table:
        return "–"
    viscosity, before, seconds = table[key][-1]
    return f"{viscosity:.2f} ({before:.2f}), {seconds:.0f} s"


def print_tables(table):
    print("| |", *(f"{rate:g} /s |" for rate in RATES))
    print("|---|" + "---|" * len(RATES))
    for medium, words in SOURCES.items():
        print(f"| {words} |", *(f"{at(rate, chien(medium))} |" for rate in RATES))
    print("| Wells and Merrill 1962, 43 % |", *(f"{at(rate, measured())} |" for rate in RATES))
    print("| the same, 45 %, between 33 and 57 % |",
          *(f"{at(rate, wells_merrill(45))} |" for rate in RATES))
    print("| Cho and Kensey 1991, a fit |", *(f"{cho_kensey(rate):.1f} |" for rate in RATES))
    for kind, sigma in itertools.product(COLORS, (0, ADHESION)):
        words = f"{WORDS[kind]}, {'adhesive' if sigma else 'repulsive'}"
        keys = [label(kind, sigma, rate) for rate in RATES]
        medium = "plasma" if sigma else "albumin"
        print(f"| {words} |", *(f"{cell(table, key)} |" for key in keys))
        print(f"| off {SOURCES[medium]} |",
              *(f"{off(table, key, medium, rate)} |" for key, rate in zip(keys, RATES)))
    print()
    print("| |", *(f"{1e3 * sigma:g} µJ/m² |" for sigma in STRENGTHS))
    print("|---|" + "---|" * len(STRENGTHS))
    for rate in SLOW:
        print(f"| {rate:g} /s |",
              *(f"{cell(table, label('inside', sigma, rate))} |" for sigma in STRENGTHS))


def draw(table, path):
    figure, (rates, strengths) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    for medium, words in SOURCES.items():
        rates.plot(*chien(medium), MARKS[medium], ms=5, mfc="none", label=words)
    rates.plot(*measured(), "s", color="0.6", ms=5, label="Wells and Merrill 1962, 43 %")
    fine = np.geomspace(0.5, 400)
    rates.plot(fine, cho_kensey(fine), ":", color="0.6", label="Cho and Kensey 1991, a fit")
    for kind, sigma in itertools.product(COLORS, (0, ADHESION)):
        points = [(rate, table[label(kind, sigma, rate)][-1][0]) for rate in RATES
                  if label(kind, sigma, rate) in table]
        if points:
            rates.plot(*np.array(points).T, "o--" if sigma else "o-", ms=4, color=COLORS[kind],
                       label=f"{WORDS[kind]}, {'adhesive' if sigma else 'repulsive'}")
    rates.set(xlabel="shear rate, 1/s", ylabel="viscosity over that of plasma", xscale="log",
              yscale="log", xlim=(0.5, 450), ylim=(2.5, 40))
    rates.set_yticks((3, 5, 10, 20), ("3", "5", "10", "20"))
    rates.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    rates.legend(frameon=False, fontsize=7.5)
    for rate, color in zip(SLOW, ("#33691e", "#e07b39")):
        points = [(1e3 * sigma, table[label("inside", sigma, rate)][-1][0]) for sigma in STRENGTHS
                  if label("inside", sigma, rate) in table]
        if points:
            strengths.plot(*np.array(points).T, "o-", ms=4, color=color, label=f"{rate:g} /s")
        strengths.axhline(interpolated(rate, chien("plasma")), color=color, ls=":",
                          label=f"Chien, in plasma, {rate:g} /s")
    strengths.set(xlabel="work of adhesion, µJ/m²", ylabel="viscosity over that of plasma",
                  ylim=(0, None))
    strengths.legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    arguments = command_line.parse(example_study.options(__doc__, [*COLORS, "strengths"]), HERE)
    table = example_study.run_cases(arguments, arguments.output / "rates.csv", COLUMNS, cases(),
                                    measure)
    print_tables(table)
    draw(table, arguments.output / "rates.png")


if __name__ == "__main__":
    main()
