"""A user's input script, to be run in another folder with other values and more thermo output."""
import re
from pathlib import Path

FILES = "include", "read_data", "read_restart", "jump"     # the first word is a file
READERS = *FILES, "molecule", "region", "pair_coeff"
RUNS = "run", "minimize", "rerun"
DIGITS = "thermo_modify   line one format float %.12g"
FIX = re.compile(r"\s*fix\s+(\S+)\s+\S+\s+(\S+)")
SERIES = 200    # lines of thermo output of a run that has as many steps, or up to twice as many


def printing(run, every):
    """Lines above a line with `run` that have it print often, and no less than the script's own
    line, `thermo every`. Every how many steps is a power of two: runs whose timesteps are such
    multiples of each other print at the same times."""
    command, _, rest = run.split("#")[0].strip().partition(" ")
    if command != "run" or every.startswith("v_"):
        return []
    steps, options = first_word(rest.strip())
    done = "-step" if "upto" in options.split() else ""
    lines = [f"variable        converge_steps equal ({steps}){done}",
             "variable        converge_every equal "
             f"ceil(2^floor(ln((v_converge_steps+1)/{SERIES})/ln(2)))"]
    choice = "v_converge_every"
    if every:
        choice = f"ternary(({every}>0)&&(({every})<{choice}),{every},{choice})"
    return [*lines, f"variable        converge_thermo equal {choice}",
            "thermo          ${converge_thermo}"]


def first_word(text):
    """The first word and the rest, where $( ... ) is one word, with all that is in it."""
    depth = 0
    for n, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if letter.isspace() and not depth:
            return text[:n], text[n:]
    return text, ""


class Script:
    """Of a path. Files that it names relative to its own folder are found from any other one."""

    def __init__(self, path):
        self.path = Path(path).resolve()
        text = self.path.read_text(encoding="utf-8")
        self.lines = re.sub(r"&[ \t]*\n", " ", text).splitlines()

    def variables(self):
        """{name: default} of those that -var sets: `variable name index ...`."""
        words = [line.split("#")[0].split() for line in self.lines]
        return {line[1]: " ".join(line[3:]).strip("\"'") for line in words
                if line[:1] == ["variable"] and line[2:3] == ["index"]}

    def place(self, word, bare=False):
        """The word, or the path if it names a file or folder beside the script or in the current
        folder. Without `bare` it must look like one, with a dot or slash."""
        if "$" in word or word in (".", "..") or not (bare or "." in word or "/" in word):
            return word
        for folder in (self.path.parent, Path.cwd()):
            there = folder / word
            if there.exists() and there.resolve() not in (self.path, folder.resolve()):
                return str(there.resolve())
        return word

    def folders(self):
        """{name: path} of the variables that name a file or folder which the script reads."""
        return {name: self.place(value) for name, value in self.variables().items()
                if value and self.place(value) != value}

    def placed(self, line):
        command = (line.split() or [""])[0]
        if command not in READERS:
            return line
        return re.sub(r"\S+", lambda word: self.place(word[0], command in FILES and
                                                      word[0] != command), line)

    def can_measure(self):
        return any(line.split()[:1] and line.split()[0] in RUNS for line in self.lines)

    def can_print_often(self, measures):
        """Whether thermo output may come at any step: it may not with what fixes average, nor with
        fixes of other files, which may average."""
        styles = dict(found.groups() for found in map(FIX.match, self.lines) if found)
        used = [line for line in self.lines if line.split()[:1] in (["variable"], ["thermo_style"])]
        fixes = re.findall(r"\bf_(\w+)", " ".join([*used, *measures]))
        return all(not styles.get(name, "ave").startswith("ave") for name in fixes)

    def measuring(self, measures, series=False):
        """The script with `step time <measures>` as the last columns of thermo output. `series`:
        the last run prints at SERIES times or more, as far as it has so many steps."""
        columns = " ".join(["step time", *measures])
        lines = [self.placed(line) for line in self.lines]
        first = [line.split()[:2] for line in lines]
        styles = [n for n, words in enumerate(first) if words == ["thermo_style", "custom"]]
        runs = [n for n, words in enumerate(first) if words[:1] and words[0] in RUNS]
        every = [line.split("#")[0].strip().removeprefix("thermo").strip()
                 for line, words in zip(lines[:runs[-1]], first) if words[:1] == ["thermo"]][-1:]
        if styles:
            lines[styles[-1]] = lines[styles[-1]].split("#")[0] + " " + columns
        for n in reversed(runs):
            new = n == runs[0] and not styles
            often = printing(lines[n], "".join(every)) if series and n == runs[-1] else []
            lines[n:n] = [f"thermo_style    custom {columns}"] * new + [DIGITS, *often]
        return "\n".join(lines) + "\n"
