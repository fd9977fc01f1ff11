"""What converge.py prints, writes and draws of its runs."""
import csv
import itertools
from typing import NamedTuple

from rbc import command_line    # noqa: F401  before matplotlib, which may be missing
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.ticker import LogLocator, NullLocator  # noqa: E402
import richardson  # noqa: E402

DOUBLED = 2       # coarsest over finest from which on an order shows well
MUCH = 0.1        # of an error or of the differences of values: noise that is worth a word
WORTH_IT = 0.9    # of the core seconds of the best run: a combination that is not run is named


class Error(NamedTuple):
    """Of a setting, in the unit of the measure."""
    offset: float    # value less the limit of all that is varied; of series the root mean square
    bound: float     # what is said of its size


class Analysis:
    """Of one measure: values and noise by setting, and a fit for each that is varied, by its place,
    with the settings that are in it."""

    def __init__(self, measure, take, changes, runs, values, noise, fits):
        self.measure, self.take, self.changes, self.fits = measure, take, changes, fits
        self.values, self.noise = values, noise
        self.seconds = {run.setting: run.seconds for run in runs}
        self.finest = tuple(len(one.values) - 1 for one in changes)
        base = values[self.finest]
        self.limit = base + sum((fit.limit - base for _, fit in fits.values()), 0 * base)
        self.scale = float(richardson.size(base))
        bounds = {i: fit.bounds[line.index(self.finest)] for i, (line, fit) in fits.items()}
        unknown = sum(bounds[i] for i, (_, fit) in fits.items() if has_no_order(fit))
        # what has no order may be a small part of the error: there is a limit all the same
        self.has_limit = len(fits) == len(changes) and unknown <= MUCH * sum(bounds.values())

    def part(self, i, n):
        """The error that setting n of what is varied makes: offset (m,), what the fit adds to its
        size, and its bound; None where there is no fit or the run failed."""
        line, fit = self.fits.get(i, ((), None))
        names = [setting[i] for setting in line]
        if n not in names:
            return None
        at = names.index(n)
        offset = self.values[line[at]] - fit.limit
        return offset, fit.bounds[at] - richardson.size(offset), fit.bounds[at]

    def of(self, setting, offset):
        """The Error of a setting, run or not, whose value is that far from the limit of all.
        Errors of what is varied may cancel each other: the bound does not count on it."""
        parts = [self.part(i, n) for i, n in enumerate(setting)]
        if None in parts:
            return Error(signed(offset), np.inf)
        _, more, bounds = zip(*parts)
        return Error(signed(offset), float(max(richardson.size(offset) + sum(more), sum(bounds))))

    def error(self, setting):
        """Where no order is known no limit is, and the distance from it is not a number."""
        error = self.of(setting, self.values[setting] - self.limit)
        return error if self.has_limit else error._replace(offset=float("nan"))

    def predicted(self):
        """{setting: (Error, seconds)} of combinations that were not run: errors add, shares of the
        run time multiply."""
        base, found = self.seconds[self.finest], {}
        for setting in itertools.product(*(range(n + 1) for n in self.finest)):
            parts = [self.part(i, n) for i, n in enumerate(setting)]
            if setting in self.values or None in parts:
                continue
            alone = [self.finest[:i] + (n,) + self.finest[i + 1:] for i, n in enumerate(setting)]
            seconds = base * np.prod([self.seconds[one] / base for one in alone])
            found[setting] = self.of(setting, sum(part[0] for part in parts)), seconds
        return found

    def unit(self):
        """That errors are drawn in: percent of the scale, or by themselves where that is zero."""
        return 100 / self.scale if self.scale > 0 else 1

    def tolerance(self, within):
        number, relative = within
        return number * self.scale if relative else number

    def dominant(self, setting):
        """Place of what contributes most to the error of a setting."""
        parts = [self.part(i, n) for i, n in enumerate(setting)]
        bounds = [np.inf if part is None else part[2] for part in parts]
        return int(np.argmax(bounds))

    def noise_of(self, i):
        """The largest noise of the settings of one variable, 0 if it hardly matters."""
        line, fit = self.fits[i]
        noise = max(self.noise[setting] for setting in line)
        return noise if noise > MUCH * min(*fit.bounds, max(abs(fit.offsets))) else 0

    def remedies(self, i):
        """What would make the error that one variable causes smaller, or better known."""
        line, fit = self.fits.get(i, ((), None))
        if fit is None:
            return ["settings that run to their end"]
        one, noise, found = self.changes[i], self.noise_of(i), []
        if noise:
            what = "longer runs" if self.take == "mean" else "more lines of thermo output"
            found.append(f"{what} (noise {percent(noise, self.scale)})")
        if not has_no_order(fit):
            return [*found, "finer values"]
        sizes = [one.sizes[setting[i]] for setting in line]
        if len(line) == 2:
            found.append("a third value")
        if max(sizes) < DOUBLED * min(sizes):
            found.append(f"a coarsest over finest of {DOUBLED} or more (now "
                         f"{max(sizes) / min(sizes):.2g})")
        if len(line) == 2:
            found.append(f"--order {one.title}=P if the order P is known")
        return found or ["finer values"]


def has_no_order(fit):
    return bool(fit.why) and fit.why != richardson.SAME


def signed(offset):
    return float(offset[0] if len(offset) == 1 else richardson.size(offset))


def words(changes, setting):
    return " ".join(f"{one.title}={one.word(n)}" for one, n in zip(changes, setting))


def percent(number, scale):
    """A number as share of the scale, or by itself where that is zero; - where there is none."""
    if np.isnan(number):
        return "-"
    return f"{100 * number / scale:.3g} %" if scale > 0 else f"{number:.3g}"


def order_line(one, fit):
    """A sentence on the order that was found."""
    between = " ({:.2f} to {:.2f} with its noise)".format(*fit.between) if fit.between else ""
    if fit.why:
        return f"{one.title}: order unknown, {fit.why}{between}"
    if np.isnan(fit.observed):
        return f"{one.title}: order {fit.order:g} as given"
    text = f"{one.title}: order {fit.observed:.2f}{between}"
    return text if fit.order == fit.observed else f"{text}; errors are estimated with {fit.order:g}"


def value_of(analysis, setting):
    """The value with its noise; of a series its root mean square."""
    value, noise = analysis.values[setting], analysis.noise[setting]
    text = f"{value[0] if len(value) == 1 else richardson.size(value):.6g}"
    return f"{text} +- {noise:.2g}" if noise else text


def print_analysis(analysis):
    scale = analysis.scale
    kind = {"last": "at the end", "mean": "mean", "series": "over time, root mean square"}
    print(f"\n{analysis.measure} ({kind[analysis.take]})")
    rows = [("setting", "value", "from limit", "error below", "core s")]
    for setting in analysis.values:
        error = analysis.error(setting)
        rows.append((words(analysis.changes, setting), value_of(analysis, setting),
                     percent(error.offset, scale), percent(error.bound, scale),
                     f"{analysis.seconds[setting]:.3g}"))
    widths = [max(map(len, column)) for column in zip(*rows)]
    for first, *rest in rows:
        print("  ".join([first.ljust(widths[0]), *(text.rjust(width)
                                                   for text, width in zip(rest, widths[1:]))]))
    for i, (_, fit) in analysis.fits.items():
        print(order_line(analysis.changes[i], fit))
        if has_no_order(fit):
            print(f"  would help: {', '.join(analysis.remedies(i))}")
    for i, one in enumerate(analysis.changes):
        if i not in analysis.fits:
            print(f"{one.title}: one setting ran to its end, nothing is known of its error")
    limit = analysis.limit
    bound = analysis.error(analysis.finest).bound
    if len(limit) == 1 and analysis.has_limit:
        print(f"limit {limit[0]:.6g}, from the finest value {value_of(analysis, analysis.finest)} "
              f"with an error below {bound:.2g}")
    warn_of_costs(analysis)
    noise = max((analysis.noise_of(i) for i in analysis.fits), default=0)
    if analysis.take != "mean" and noise:
        print(f"WARNING: values between lines of thermo output are interpolated, which may be off "
              f"by {percent(noise, scale)}: have the script print more often (thermo)")


def warn_of_costs(analysis):
    """A list from fine to coarse would give nonsense: then what is taken as finer costs less."""
    for i, (line, _) in analysis.fits.items():
        seconds = [analysis.seconds[setting] for setting in sorted(line)]
        if len(seconds) > 1 and seconds[-1] < 0.5 * seconds[0]:
            print(f"WARNING: {analysis.changes[i].title}: the finest setting took less time than "
                  "the coarsest; values are listed from coarse to fine")


def cheapest(analyses, candidates, within):
    """(seconds, setting) of the cheapest of candidates, {setting: ([Error], seconds)}, with all
    measures below the error asked for; None if there is none."""
    good = [(seconds, setting) for setting, (errors, seconds) in candidates.items()
            if all(error.bound <= analysis.tolerance(within)
                   for error, analysis in zip(errors, analyses))]
    return min(good, default=None)


def print_choice(analyses, within, asked):
    first = analyses[0]
    run = {setting: ([one.error(setting) for one in analyses], first.seconds[setting])
           for setting in first.values}
    best = cheapest(analyses, run, within)
    print(f"\ncheapest run with an error below {asked}: " + (
        f"{words(first.changes, best[1])}, {best[0]:.3g} core s" if best else "none"))
    if not best:
        for one in analyses:
            if one.error(one.finest).bound > one.tolerance(within):
                i = one.dominant(one.finest)
                print(f"  would help for {one.measure}: {one.changes[i].title}: "
                      f"{', '.join(one.remedies(i))}")
    parts = [one.predicted() for one in analyses]
    guess = {setting: ([part[setting][0] for part in parts], parts[0][setting][1])
             for setting in parts[0] if all(setting in part for part in parts)}
    better = cheapest(analyses, guess, within)
    if better and (best is None or better[0] < WORTH_IT * best[0]):
        print(f"not run, if errors add: {words(first.changes, better[1])}, about "
              f"{better[0]:.3g} core s")
    if len(first.changes) > 1:
        at = best[1] if best else first.finest
        for one in analyses:
            print(f"most of the error bound of {one.measure} at {words(first.changes, at)}: "
                  f"{one.changes[one.dominant(at)].title}")


def write_table(analyses, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["measure", *(one.title for one in analyses[0].changes), "value", "noise",
                         "from_limit", "error_below", "scale", "core_seconds"])
        for one in analyses:
            for setting, value in one.values.items():
                error = one.error(setting)
                numbers = (value[0] if len(value) == 1 else richardson.size(value),
                           one.noise[setting], *error, one.scale, one.seconds[setting])
                writer.writerow([one.measure, *(change.word(n) for change, n in
                                                zip(one.changes, setting)),
                                 *(f"{number:.8g}" for number in numbers)])


def draw_line(panel, analysis, i, color):
    """The settings of one that is varied, on axes of seconds and percent (or the unit)."""
    line, title = sorted(analysis.fits[i][0]), analysis.changes[i].title
    seconds = [analysis.seconds[setting] for setting in line]
    errors = [analysis.error(setting) for setting in line]
    unit = analysis.unit()
    panel.plot(seconds, [unit * error.bound for error in errors], "o-", color=color,
               label=f"{title}, error below")
    if analysis.has_limit:
        panel.plot(seconds, [unit * abs(error.offset) for error in errors], "o:", mfc="none",
                   color=color, label=f"{title}, from the limit")
    for setting, second, error in zip(line, seconds, errors):
        word = "finest" if setting == analysis.finest else analysis.changes[i].word(setting[i])
        if word != "finest" or color == "C0":
            panel.annotate(word, (second, unit * error.bound), xytext=(4, 4),
                           textcoords="offset points", fontsize=7)


def draw(analyses, arguments, path):
    """Error against core seconds, a panel for each measure."""
    figure, panels = plt.subplots(1, len(analyses), figsize=(5.6 * len(analyses), 4.8),
                                  layout="constrained", squeeze=False)
    for one, panel in zip(analyses, panels[0]):
        for n, i in enumerate(one.fits):
            draw_line(panel, one, i, f"C{n}")
        rest = [setting for setting in one.values
                if not any(setting in line for line, _ in one.fits.values())]
        if rest:
            panel.plot([one.seconds[setting] for setting in rest],
                       [one.unit() * one.error(setting).bound for setting in rest], ".",
                       color="0.5", label="other combinations, error below")
        if arguments.within:
            panel.axhline(one.unit() * one.tolerance(arguments.within), color="0.6", lw=1)
        some = any(one.error(setting).bound > 0 for setting in one.values)
        panel.set(title=one.measure, xscale="log", yscale="log" if some else "linear",
                  xlabel="core seconds", ylabel="error (%)" if one.scale > 0 else "error")
        for axis in (panel.xaxis, panel.yaxis) if some else (panel.xaxis,):
            axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter("{x:g}")
        panel.legend(frameon=False, fontsize=8, ncols=2, loc="upper center",
                     bbox_to_anchor=(0.5, -0.14))
    figure.savefig(path, dpi=100)


def report(analyses, arguments):
    for one in analyses:
        print_analysis(one)
    if arguments.within:
        number, relative = arguments.within
        asked = f"{100 * number:g} %" if relative else f"{number:g}"
        print_choice(analyses, arguments.within, asked)
    write_table(analyses, arguments.output / "converge.csv")
    draw(analyses, arguments, arguments.output / "converge.png")
