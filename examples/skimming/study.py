#!/usr/bin/python3
"""How many of the cells go into a daughter that gets a share of the blood: plasma skimming where a
vessel parts, beside the law of Pries et al.

Runs in.skimming for each share, in a folder of its own, or goes on with it from its last restart
file until --steps. A share below a half begins with the cells of the one above it where that has
ended: which side they have come to lie on then counts once for each daughter. Writes skimming.csv
and skimming.png from the skimming.dat that are there.

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
MIRRORED = {"0.1": "0.9", "0.25": "0.75", "0.4": "0.6"}    # share: whose cells it goes on with
TABLE = "skimming.dat"
TURNED = 3.0e3    # volume that enters, um^3, before cells count where the shares have changed
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
    step, ms, stream, into = data[:, 0], data[:, 1], data[:, 2:-2], data[:, -2:]
    return dict(step=step, ms=ms, entered=stream[:, 0], left=stream[:, 1], inside=stream[:, 2],
                owed=stream[:, 3], volume=stream[:, 6], volumes=stream[:, [10, 13]],
                gone=stream[:, [8, 11]], into=into)


def skimmed(rows, begin):
    """Cells that went into the daughters since the volume `begin` (um^3) had entered, the part of
    the first and its standard error, discharge hematocrits of both, the share of the blood."""
    late = rows["volume"] >= begin
    times = np.linspace(0, late.sum() - 1, BLOCKS + 1).round().astype(int)
    cells = np.diff(rows["into"][late][times], axis=0)
    return account(cells, np.diff(rows["volumes"][late][[0, -1]], axis=0)[0])


def both(row, mirrored):
    """Of a share and of its mirror image, whose daughters change places."""
    return account(np.concatenate([row["blocks"], mirrored["blocks"][:, ::-1]]),
                   row["flows"] + mirrored["flows"][::-1])


def account(cells, flows):
    """Of cells that went into the first and the second daughter in each block, and of the volumes
    of blood that did so in all."""
    total, blocks = cells.sum(axis=0), len(cells)
    part = total[0] / total.sum()
    likely = (total[0] + 1) / (total.sum() + 2)    # Laplace's rule: if all went there, one may not
    counted = np.sqrt(likely * (1 - likely) / (total.sum() + 2))
    off = cells[:, 0] - part * cells.sum(axis=1)
    between = np.sqrt((off**2).sum() * blocks / (blocks - 1)) / total.sum()
    return dict(share=flows[0] / flows.sum(), cells=total.sum(), first=total[0], part=part,
                error=max(counted, between), counted=counted, between=between,
                hematocrit1=total[0] * VOLUME / flows[0], hematocrit2=total[1] * VOLUME / flows[1],
                feed=total.sum() * VOLUME / flows.sum(), blocks=cells, flows=flows)


def run(arguments, share, folder):
    """Begins, or goes on from the last restart file; makes --steps in all, behind those of the run
    whose cells it has."""
    folder.mkdir(parents=True, exist_ok=True)
    before = folder.parent / MIRRORED.get(share, share)
    places = dict(tables=HERE, scripts=HERE.parents[1] / "scripts", share=share,
                  seed=CASES[before.name], steps=arguments.steps)
    kept = [place / "last.restart" for place in (folder, before)]
    begun = next((file for file in kept if file.exists()), None)
    if begun:
        places["from"] = begun.resolve()
    if share in MIRRORED:
        steps = read(begun.parent / TABLE)["step"]
        places["steps"] += round(steps[0 if begun.parent == folder else -1])
    pieces = len(list(folder.glob("log.*")))
    example_study.run_script(arguments, HERE / "in.skimming", folder, places,
                             log=f"log.{pieces + 1}").check_returncode()


def law(function, share):
    return float(function(share, HEMATOCRIT, FEED, DAUGHTER, DAUGHTER))


def collected(arguments):
    """{share: numbers} of the runs that are there, and of both where there are two with it."""
    results = {}
    for share in (*CASES, *MIRRORED):
        table = example_study.runs_folder(arguments) / share / TABLE
        if table.exists():
            rows = read(table)
            begin = arguments.skip if share in CASES else rows["volume"][0] + TURNED
            if rows["volume"][-1] > begin:
                results[share] = skimmed(rows, begin)
    for share, other in MIRRORED.items():
        if share in results and other in results:
            results[f"{other} both"] = both(results[other], results[share])
    for row in results.values():
        for function in (pries_2005, pries_1989):
            row[function.__name__] = law(function, row["share"])
    return results


def report(results):
    print("share of the blood, cells, part of them, by counting and between blocks +-, Pries 2005, "
          "1989; discharge hematocrits of the daughters and of both")
    for name, row in results.items():
        print(f"{name:9} {row['cells']:6.1f}  {row['part']:.3f} +- {row['counted']:.3f} "
              f"{row['between']:.3f}  {row['pries_2005']:.3f} {row['pries_1989']:.3f}   "
              f"{row['hematocrit1']:.3f} {row['hematocrit2']:.3f} {row['feed']:.3f}")


def shown(results):
    """Of each share the one with most cells."""
    return {name: row for name, row in results.items() if f"{name} both" not in results
            and not (name in MIRRORED and MIRRORED[name] in results)}


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
    right.errorbar([], [], [], fmt="o", color="#b3202a", ms=4, capsize=3,
                   label="counted, two standard errors")
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
    parser = example_study.options(__doc__, [*CASES, *MIRRORED])
    example_study.add_runs_folder(parser)
    parser.add_argument("--steps", type=int, help="of each run; default: read those that are there")
    parser.add_argument("--skip", type=float, default=1.5e4,
                        help="volume that enters before cells are counted, um^3 (1.5e4)")
    arguments = command_line.parse(parser, HERE)
    for share in (*CASES, *MIRRORED) if arguments.steps else ():
        if example_study.wanted(arguments, share):
            run(arguments, share, example_study.runs_folder(arguments) / share)
    results = collected(arguments)
    if not results:
        parser.error("no run goes beyond --skip; --steps 700 makes such runs")
    report(results)
    numbers = {name: {key: value for key, value in row.items() if np.ndim(value) == 0}
               for name, row in results.items()}
    example_study.write_rows(numbers, arguments.output / "skimming.csv")
    plot(shown(results), arguments.output / "skimming.png")


if __name__ == "__main__":
    main()
