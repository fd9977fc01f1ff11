"""The figures of doc/validation.rst, each from the tables in the repository: a function for each
example or benchmark gives them by name. Errors are in percent unless their name says else."""
import math
import re

from rbc import command_line    # before numpy, which may be missing
import numpy as np

from rbc import thermo_log
from validation_tables import (EXAMPLES, Figures, bench_times, chosen, minutes, one, rows,
                               script, study)

LINE = "Error against run time"      # the heading of tables that converge.py wrote


def least_and_most(values):
    values = list(values)
    return [min(values), max(values)]


def off(value, reference):
    return 100 * (value / reference - 1)


def order(coarse, fine, ratio=2):
    return math.log(abs(coarse / fine), ratio)


def column(path, name, which=-1):
    """Of the table in a log that is the `which`-th."""
    names, values = thermo_log.tables(path.read_text(encoding="utf-8"))[which]
    return values[:, names.index(name)]


def divergence():
    """Times dx over the largest speed, in the logs of scenes with one viscosity, and with two."""
    found = {False: [], True: []}
    for path in sorted(EXAMPLES.glob("*/log.*")):
        for names, values in thermo_log.tables(path.read_text(encoding="utf-8")):
            if "f_flow[11]" in names:
                iterates = "f_ib[11]" in names and values[-1, names.index("f_ib[11]")] > 0
                found[iterates].append(values[:, names.index("f_flow[11]")].max())
    return Figures(one=max(found[False]), two=max(found[True]))


def drag():
    """Of spheres of 6 dx in cubic arrays; between plates, off their middle."""
    def errors(kernel):
        return least_and_most(
            abs(row["error_percent"]) for row in chosen("bench/drag.csv", setting="array",
                                                        kernel=kernel)
            if abs(row["radius_over_dx"] - 6) < 0.1)
    return Figures(roma3=errors("roma3"), peskin4=errors("peskin4"), takes=bench_times()["drag"])


def curved_walls():
    """Sheets with roma3: spheres of 7 dx in arrays, and on the axis of a tube 16 dx in radius."""
    table = chosen("bench/curved_walls.csv", kernel="roma3", kind="sheets")
    array = [abs(row["error_percent"]) for row in table
             if row["setting"] == "array" and 7 < row["radius_over_dx"] < 8]
    tube = [abs(row["error_percent"]) for row in table
            if row["setting"] == "sphere in tube" and row["radius_over_dx"] == 16]
    return Figures(array=max(array), tube=tube, takes=bench_times()["curved_walls"])


def ports():
    """Tubes of 4 diameters, 20 and 40 dx wide."""
    table = [one("examples/ports/ports.csv", case=f"peskin4 dx {dx}") for dx in ("0.8", "0.4")]
    return Figures(profile=[100 * row["profile"] for row in table],
                   gradient=[100 * row["gradient"] for row in table],
                   lost=max(abs(row["halfway"]) for row in table))


def network():
    """Parts of the flow of the inlet, which is that of the first segment."""
    def away(case):
        table = chosen("examples/network/flows.csv", case=case)
        flow = np.array([row["flow"] for row in table])
        law = np.array([row["poiseuille"] for row in table])
        return 100 * (flow - law) / law[0]
    cases = list(dict.fromkeys(row["case"] for row in rows("examples/network/flows.csv")))
    finest = away(cases[-1])
    return Figures(spacing=cases[-1], rms=np.sqrt((finest**2).mean()), most=abs(finest).max())


def stream():
    """Of its README: stream.csv has every fifth row of the run only."""
    text = (EXAMPLES / "stream" / "README.md").read_text(encoding="utf-8")
    entered, left = re.search(r"^\| second to tenth \| (\S+ ± \S+) \| "
                              r"(\S+ ± \S+) \|$", text, re.MULTILINE).groups()
    return Figures(entered=entered, left=left)


def skimming():
    """At three shares of the blood, that of the middle from two runs together."""
    table = {str(row["case"]): row for row in rows("examples/skimming/skimming.csv")}
    cases = [table[name] for name in ("0.9", "0.75 both", "0.6")]
    return Figures(cells=least_and_most(row["cells"] for row in cases),
                   part=[100 * row["part"] for row in cases],
                   error=[100 * row["error"] for row in cases],
                   law=[100 * row["pries_2005"] for row in cases])


def bending():
    table = {row["vertices"]: row for row in chosen("bench/bending.csv", form="helfrich")}
    return Figures(sphere=100 * table[2562]["sphere_energy"],
                   disc=100 * abs(table[642]["disc_energy"]),
                   order=order(table[642]["disc_energy"], table[2562]["disc_energy"]),
                   takes=bench_times()["bending"])


def stretch():
    found = study("stretch").deviations(
        chosen("examples/stretch/stretch.csv", case="healthy.material"))[:, 1:]
    return Figures(inside=(abs(found) <= 1).sum(), bars=found.size, worst=abs(found).max())


def relaxation():
    module = study("relaxation")
    times = [module.fit(*curve)[0] for curve in module.read(module.REFERENCE).values()]
    here = module.fit(*module.read(EXAMPLES / "relaxation" / "relaxation.csv")["thinning"])
    return Figures(data=least_and_most(times), here=here[0])


def tank_treading():
    module = study("tank-treading")
    table = [row for row in module.read(EXAMPLES / "tank-treading" / "tank-treading.csv")
             if row.case == "thinning"]
    measured = module.reference("03b_ttf_fischer_28p9mPas_binned.csv")
    errors = [off(row.frequency, measured[np.argmin(abs(measured[:, 0] - row.rate)), 1])
              for row in table if row.part == "frequency" and not module.tumbles(row)]
    angles = module.reference("03c_rbc_inclination_fischer2015.csv")
    lags = []
    for row in table:
        theirs = angles[angles[:, 0] == row.medium]
        if row.part == "inclination":
            near = theirs[np.argmin(abs(np.log(theirs[:, 1] / row.rate)))]
            lags.append(near[2] - row.inclination)
    rates = [row.rate for row in table if row.part == "frequency" and not module.tumbles(row)]
    tumbling = max(row.rate for row in table if module.tumbles(row))
    return Figures(frequency=least_and_most(errors), lag=least_and_most(lags),
                   rate=least_and_most(rates), tumbles=tumbling)


def volume():
    found = column(EXAMPLES / "shear-cell" / "log.29Nov26.shear-cell.g++.1", "c_cell[1][6]")
    return Figures(change=abs(found / found[0] - 1).max())


def stiff():
    """Spheroids of 12 dx: period in an unbounded fluid over Jeffery's. Places on the grid other
    than the middle of a cell were run in the smallest box alone."""
    module, table = study("stiff"), rows("examples/stiff/stiff.csv")
    limit, smallest = {}, {}
    for body, (_, periods) in module.spheroids(
            module.read(EXAMPLES / "stiff" / "stiff.csv")).items():
        aspect, *settings, place, stiffer = body
        if settings == [362, 12, "roma3", "yes"] and stiffer == 1:
            smallest[aspect, place] = periods[min(periods)]
            if len(periods) > 1:
                limit[aspect] = off(module.unbounded(periods), module.jeffery_period(aspect))
    thin = min(limit)
    places = [limit[thin] + off(period, smallest[thin, 0])
              for (aspect, _), period in smallest.items() if aspect == thin]
    coarse = [row for row in table if row["shape"].startswith("spheroid_0.328_") and
              round(row["box"]) == 20 and round(row["dx"], 3) == 0.978 and row["stiffer"] == 1 and
              row["kernel"] == "roma3"]
    smooth = {row["shape"]: row["period"] for row in coarse if row["smooth"] == "yes"}
    rough = [off(row["period"], smooth[row["shape"]]) for row in coarse if row["smooth"] == "no"]
    seconds = sum(row["core_s"] for row in table if row["shape"].startswith("spheroid"))
    return Figures(round=limit[0.9], half=limit[0.5], thin=least_and_most(places),
                   shorter=-min(rough), longer=max(rough), takes=minutes(seconds))


def capsule_channel():
    """Stiff ones beside rigid spheres: 24 dx in a radius of the tube; extrapolated from 16, too."""
    module, table = study("capsule-channel"), rows("examples/capsule-channel/capsule-channel.csv")
    speeds = {(row["a/R"], row["cells"]): row["U"] for row in table if row["Ca"] == 0.001}
    finest, limits = [], []
    for ratio, exact in module.RIGID.items():
        coarse, fine = (speeds[ratio, cells] for cells in (16, 24))
        finest.append(off(fine, exact))
        limits.append(abs(off((24**2 * fine - 16**2 * coarse) / (24**2 - 16**2), exact)))
    return Figures(finest=least_and_most(finest), limit=max(limits))


def capsule_shear():
    module = study("capsule-shear")
    table = module.load(EXAMPLES / "capsule-shear" / "study.csv")
    boxes = [(float(row["length"]), float(row["D_end"]))
             for row in module.select(table, "slope-box")]
    slope = (module.to_zero_dx([(float(row["dx"]), float(row["D_end"]) / float(row["Ca"]))
                                for row in module.select(table, "slope", kernel="roma3")]) *
             module.to_infinite_box(boxes) / dict(boxes)[8.0])
    errors = []
    for row in module.select(table, "base"):
        ca = float(row["Ca"])
        for time, value in zip(*module.references(ca)["Pozrikidis1995"]):
            if any(np.isclose(time, (0.5, 1, 1.5))):
                limit = (module.at(row, time) * module.box_factor(table, ca, time) *
                         module.dx_factor(table, ca, time))
                errors.append(off(limit, value))
    seconds = sum(float(row["loop_seconds"]) for row in table.values())
    return Figures(slope=off(slope, 25 / 12), transient=max(map(abs, errors)),
                   takes=minutes(seconds))


def python():
    """Means of the last fifth of each piece, whose target steps up once."""
    module = script("examples/python/drive.py")
    table = np.array([list(row.values()) for row in rows("examples/python/python.csv")])
    half = len(table) // 2
    held, above = [], []
    for piece in (table[:half], table[half:]):
        late = piece[piece[:, 0] > piece[-1, 0] - 0.2 * (piece[-1, 0] - piece[0, 0])]
        held.append(late[:, 2].mean())
        least, most = module.published_at(late[:, 1].mean())
        above.append(off(held[-1], most) if held[-1] > most else
                     min(0, off(held[-1], least)))
    return Figures(held=held, outside=above)


def contrast():
    """Largest errors of neo-Hookean and Mooney-Rivlin capsules, extrapolated: up to a strain of 2,
    and in the end."""
    module = study("contrast")
    laws = ("neo-Hookean", module.RATIOS), ("Mooney-Rivlin psi=0.5", (5,))
    steady = rows("examples/reference/02k_capsule_shear_BEM_contrast_steady.csv")

    def in_the_end(law, inside):
        row, = (row for row in steady if (row["law"], row["lambda"]) == (law, inside))
        return np.array([row[name] for name in ("D_ell", "inclination_deg",
                                                "tank_tread_period_gdot")])

    def measured(path, names, series, times, exact):
        table = {}
        for row in rows(f"examples/contrast/{path}"):
            table.setdefault(row["case"], []).append([row[name] for name in names])
        table = {name: np.array(found) for name, found in table.items()
                 if name.split(" ")[0] in series}
        errors = [off(module.extrapolated(table, one, inside, time), exact(law, inside, time))
                  for one, (law, ratios) in zip(series, laws)
                  for inside in ratios for time in times(inside)]
        return Figures(most=max(abs(found).max() for found in errors),
                       takes=minutes(sum(found[-1, -1] for found in table.values())))

    return Figures(
        transient=measured("contrast.csv", module.COLUMNS, ("contrast", "mooney"),
                           lambda inside: module.STRAINS,
                           lambda law, inside, time: module.exact_at(inside, time, law)),
        steady=measured("steady.csv", module.STEADY_COLUMNS, ("steady", "steady-mooney"),
                        lambda inside: [module.LONG[inside]],
                        lambda law, inside, time: in_the_end(law, inside)))


def fahraeus():
    """Viscosity beside the fit of Pries et al., inside as viscous as plasma."""
    def errors(*tubes):
        return least_and_most(
            off(row["viscosity_last"], row["pries_viscosity"])
            for row in rows("examples/fahraeus/fahraeus.csv")
            if row["case"].split("-")[0] in tubes and not row["case"].endswith("inside"))
    return Figures(most=errors("d10h30", "d20h30", "d20h45", "d40h30", "d40h45"),
                   narrow=errors("d10h45"))


def suspension():
    """Blood of 45 % on 0.8 um: viscosities, seconds, and errors of mesh and grid."""
    module = script("examples/suspension/converge.py")
    table = {}
    for row in rows("examples/suspension/convergence.csv"):
        table[row["case"]] = [(row["viscosity"], row["core_seconds"])]
    runs = {scene: module.runs_of(table, scene) for scene in ("a10", "r100")}
    errors = {scene: off(found["roma3"]["rbc_162", 0.8][0], module.limit(found))
              for scene, found in runs.items()}
    large = {row["case"]: row for row in rows("examples/suspension/suspension.csv")}
    measured = script("examples/suspension/healthy.py").measured()
    return Figures(viscosity={rate: large[f"a{rate}"]["viscosity"] for rate in (10, 100)},
                   seconds={rate: large[f"a{rate}"]["core_seconds"] for rate in (10, 100)},
                   slow=errors["a10"], fast=errors["r100"],
                   wells_merrill=[measured[1][np.argmin(abs(measured[0] - rate))]
                                  for rate in (12.5, 124)])


def slow_blood():
    """The same of 45 % with an inside and membranes that are viscous, beside Chien's cells."""
    module = script("examples/suspension/rates.py")
    table = {row["case"]: row for row in rows("examples/suspension/rates.csv")}
    rates = 12.5, 62, 124
    here = [table[f"healthy 0 {rate:g}"] for rate in rates]
    data = [module.interpolated(rate, module.chien("albumin")) for rate in rates]
    return Figures(viscosity=[row["viscosity"] for row in here], chien=data,
                   off=[off(row["viscosity"], value) for row, value in zip(here, data)],
                   takes=minutes(sum(row["core_seconds"] for row in here)))


def ranks():
    """How far cells of each scene move before vertices on 2 or 4 tasks are 1e-6 diameters off."""
    moved = {}
    for row in rows("bench/ranks.csv"):
        before = moved.setdefault(row["scene"], [])
        apart = max(row["apart_2_ranks"], row["apart_4_ranks"])
        before.append((row["moved_diameters"], apart < 1e-6))
    same = [next((pairs[n - 1][0] for n, (_, near) in enumerate(pairs) if not near), pairs[-1][0])
            for pairs in moved.values()]
    return Figures(moved=least_and_most(same), takes=bench_times()["ranks"])


def kernels():
    """Least times of one rank."""
    table = chosen("bench/kernels.csv", ranks=1)

    def solves(part):
        found = [row for row in table if row["part"] == part]
        return Figures(ns=least_and_most(row["least"] for row in found),
                       ratio=least_and_most(row["least"] / row["fftw_estimate"] for row in found))
    vertices = [row["least"] for row in table if row["part"] in ("spread", "interpolate")]
    return Figures(walled=solves("walled"), periodic=solves("periodic"),
                   vertex=least_and_most(vertices))


def scaling():
    return Figures(two=one("bench/scaling.csv", scene="fluid", ranks=2,
                           layout="default")["speed_up"])


def membrane():
    return Figures(us=[0.001 * value for value in least_and_most(
        row["least_ns_per_vertex"] for row in rows("bench/membrane.csv")
        if row["bending"] in ("dihedral", "helfrich"))])


def contact():
    evaluation, both = (one("bench/contact.csv", pair="adhesive", what=what)["us_per_vertex"]
                        for what in ("evaluation", "search and evaluation"))
    return Figures(evaluation=evaluation, search=both - evaluation)


def couette_start():
    """Nanoseconds per cell and step at 64 cells between the plates, and run times over ours."""
    module, table = script("bench/couette_start.py"), rows("bench/couette_start.csv")
    spacing = module.GAP / module.COST_GRID
    steps = {code: min(row["ns_per_cell_step"] for row in table
                       if row["code"] == code and row["dx"] == spacing)
             for code in (module.OURS, module.D3Q15, module.D3Q19)}
    here = steps.pop(module.OURS)

    def runs(code):
        return sorted(module.summary(row for row in table if row["code"] == code))
    longer, ours = [], runs(module.OURS)
    for code in steps:
        lowest = np.inf
        for seconds, error in runs(code):
            if error < lowest:    # no quicker run is as good
                lowest = error
                longer.append(seconds / min(s for s, e in ours if e <= error))
    return Figures(here=here, lb=least_and_most(steps.values()), longer=least_and_most(longer))


def cost():
    """Core seconds of a physical ms of 32 cells at 100 /s, a strain of 5."""
    milliseconds = 5 / 100 * 1e3
    found = {name: one("examples/suspension/convergence.csv",
                       case=f"r100 roma3 {name}")["core_seconds"] / milliseconds
             for name in ("rbc_642 0.5", "rbc_162 0.65")}
    return Figures(fine=found["rbc_642 0.5"], fine_cell=found["rbc_642 0.5"] / 32,
                   coarse=found["rbc_162 0.65"], coarse_cell=found["rbc_162 0.65"] / 32)


def converge():
    """Of each example with a table by converge.py the cheapest setting within the error that its
    README asks for."""
    found = {}
    for path in sorted(EXAMPLES.glob("*/converge.csv")):
        text = (path.parent / "README.md").read_text(encoding="utf-8")
        asked = float(re.search(r"--within ([\d.]+)%", text.split(f"\n## {LINE}\n")[1])[1])
        table = rows(path.relative_to(EXAMPLES.parent))
        measure = table[0]["measure"]
        good = [row for row in table if row["measure"] == measure and
                100 * row["error_below"] <= asked * abs(row["scale"])]
        if not good:
            raise ValueError(f"{path}: no error is below {asked:g} %")
        best = min(good, key=lambda row: row["core_seconds"])
        found[path.parent.name] = Figures(
            setting=setting(best), error=100 * best["error_below"] / abs(best["scale"]),
            seconds=best["core_seconds"])
    return found


def setting(row):
    """Names and values of what was varied, as in `dx 0.25, capsule_162`."""
    names = list(row)[1:list(row).index("value")]
    pairs = [pair for name in names
             for pair in zip(name.split(":"), str(row[name]).split(":"))]
    return ", ".join(word if name == "shape" else f"{name} {float(word):g}"
                     for name, word in pairs)


FIGURES = (divergence, drag, curved_walls, ports, network, stream, skimming, bending, stretch,
           relaxation, tank_treading, volume, stiff, capsule_channel, capsule_shear, python,
           contrast, fahraeus, suspension, slow_blood, ranks, kernels, scaling, membrane, contact,
           couette_start, cost, converge)


def figures():
    return {function.__name__: function() for function in FIGURES}
