#!/usr/bin/python3
"""How many of the cells go into a daughter that gets a share of the blood: plasma skimming where a
vessel parts, beside the law of Pries et al.

Runs in.skimming for each share, in a folder of its own, or goes on with it from its last restart
file until --steps. Writes skimming.csv and skimming.png from the skimming.dat that are there.

study.py --output FOLDER [--folder RUNS] [--steps N] [--lmp ../../build/lmp_rbc] [--only 0.9]
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402

# of in.skimming and segments.csv, in um
HEMATOCRIT, FEED, DAUGHTER, VOLUME = 0.2, 20.0, 16.0, 89.31
CASES = {"0.9": 4711, "0.75": 4712, "0.6": 4713}    # share of the first daughter: seed
BLOCKS = 10       # parts of a run between which cells that went into a daughter are compared


def logit(x):
    return np.log(x / (1 - x))


def split(share, a, b, least):
    """Part of the cells that goes into a daughter with this share of the blood."""
    part = np.clip((np.asarray(share, dtype=float) - least) / (1 - 2 * least), 1e-15, 1 - 1e-15)
    cells = 1 / (1 + np.exp(-(a + b * logit(part))))
    return np.where(share <= least, 0.0, np.where(share >= 1 - least, 1.0, cells))


def pries_1989(share, hematocrit, feed, own, other):
    """As fitted at first: Pries, Ley, Claassen and Gaehtgens, Microvasc Res 38, 81 (1989).

    `feed`, `own`, `other` are diameters in um, the hematocrit is that of discharge in the feeding
    vessel.
    """
    return split(share, -6.96 * np.log(own / other) / feed, 1 + 6.98 * (1 - hematocrit) / feed,
                 0.4 / feed)


def pries_2005(share, hematocrit, feed, own, other):
    """The later fit to the same and more data: Pries and Secomb, Am J Physiol 289, H2657 (2005)."""
    plasma, ratio = (1 - hematocrit) / feed, own**2 / other**2
    return split(share, -13.29 * (ratio - 1) / (ratio + 1) * plasma, 1 + 6.98 * plasma,
                 0.964 * plasma)


def read(path):
    """{name: values over time} of skimming.dat. A run that went on from a restart file has written
    some steps twice."""
    data = np.loadtxt(path, ndmin=2)
    data = data[np.unique(data[::-1, 0], return_index=True)[1] * -1 + len(data) - 1]
    step, ms, stream, into = data[:, 0], data[:, 1], data[:, 2:16], data[:, 16:18]
    return dict(step=step, ms=ms, entered=stream[:, 0], left=stream[:, 1], inside=stream[:, 2],
                owed=stream[:, 3], volume=stream[:, 6], volumes=stream[:, [10, 13]],
                gone=stream[:, [8, 11]], into=into)


def skimmed(rows, begin):
    """Cells that went into the daughters since the volume `begin` (um^3) had entered, the part of
    the first and its standard error, discharge hematocrits of both, the share of the blood."""
    late = rows["volume"] >= begin
    times = np.linspace(0, late.sum() - 1, BLOCKS + 1).round().astype(int)
    cells = np.diff(rows["into"][late][times], axis=0)
    total, flows = cells.sum(axis=0), np.diff(rows["volumes"][late][[0, -1]], axis=0)[0]
    part = total[0] / total.sum()
    likely = (total[0] + 1) / (total.sum() + 2)    # Laplace's rule: if all went there, one may not
    counted = np.sqrt(likely * (1 - likely) / (total.sum() + 2))
    off = cells[:, 0] - part * cells.sum(axis=1)
    between = np.sqrt((off**2).sum() * BLOCKS / (BLOCKS - 1)) / total.sum()
    return dict(share=flows[0] / flows.sum(), cells=total.sum(), first=total[0], part=part,
                error=max(counted, between), counted=counted, between=between,
                hematocrit1=total[0] * VOLUME / flows[0], hematocrit2=total[1] * VOLUME / flows[1],
                feed=total.sum() * VOLUME / flows.sum())


def run(arguments, share, folder):
    """Begins, or goes on from the last restart file."""
    folder.mkdir(parents=True, exist_ok=True)
    places = dict(tables=HERE, scripts=HERE.parents[1] / "scripts", steps=arguments.steps,
                  share=share, seed=CASES[share])
    if (folder / "last.restart").exists():
        places["from"] = "last.restart"
    pieces = len(list(folder.glob("log.*")))
    example_study.run_script(arguments, HERE / "in.skimming", folder, places,
                             log=f"log.{pieces + 1}").check_returncode()


def law(function, share):
    return float(function(share, HEMATOCRIT, FEED, DAUGHTER, DAUGHTER))


def report(results):
    print("share of the blood, cells, part of them, by counting and between blocks +-, Pries 2005, "
          "1989; discharge hematocrits of the daughters and of both")
    for row in results.values():
        print(f"{row['share']:.4f} {row['cells']:6.1f}  {row['part']:.3f} +- {row['counted']:.3f} "
              f"{row['between']:.3f}  {row['pries2005']:.3f} {row['pries1989']:.3f}   "
              f"{row['hematocrit1']:.3f} {row['hematocrit2']:.3f} {row['feed']:.3f}")


def plot(results, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
    shares = np.linspace(0, 1, 1001)
    inner = shares[1:-1]
    for function, style, label in ((pries_2005, "-", "Pries and Secomb 2005"),
                                   (pries_1989, "--", "Pries et al. 1989")):
        curve = function(shares, HEMATOCRIT, FEED, DAUGHTER, DAUGHTER)
        left.plot(shares, curve, style, color="#555555", label=label)
        right.plot(inner, curve[1:-1] / inner, style, color="#555555", label=label)
    left.plot([0, 1], [0, 1], ":", color="#999999", label="no skimming")
    right.axhline(1, ls=":", color="#999999")
    for row in results.values():
        for share, part in ((row["share"], row["part"]), (1 - row["share"], 1 - row["part"])):
            left.errorbar(share, part, 2 * row["error"], fmt="o", color="#b3202a", ms=4, capsize=3)
            right.errorbar(share, part / share, 2 * row["error"] / share, fmt="o",
                           color="#b3202a", ms=4, capsize=3)
    left.set(xlabel="part of the blood that enters a daughter",
             ylabel="part of the cells that enters it")
    right.set(xlabel="part of the blood that enters a daughter",
              ylabel="discharge hematocrit, of the feeding tube's", ylim=(0, 1.3))
    for axes in (left, right):
        axes.legend(fontsize=8)
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = example_study.options(__doc__, list(CASES))
    example_study.add_runs_folder(parser)
    parser.add_argument("--steps", type=int, help="number of the last step; default: read runs")
    parser.add_argument("--skip", type=float, default=5.0e4,
                        help="volume that enters before cells are counted, um^3 (5.0e4)")
    arguments = command_line.parse(parser, HERE)
    results = {}
    for share in CASES:
        folder = example_study.runs_folder(arguments) / share
        if arguments.steps and example_study.wanted(arguments, share):
            run(arguments, share, folder)
        if (folder / "skimming.dat").exists():
            row = skimmed(read(folder / "skimming.dat"), arguments.skip)
            laws = dict(pries2005=law(pries_2005, row["share"]),
                        pries1989=law(pries_1989, row["share"]))
            results[share] = {**row, **laws}
    if not results:
        parser.error("there are no runs; --steps 1500 makes them")
    report(results)
    example_study.write_rows(results, arguments.output / "skimming.csv")
    plot(results, arguments.output / "skimming.png")


if __name__ == "__main__":
    main()
