"""A user's input script, to be run in another folder with other values and more thermo output."""
import re
from pathlib import Path

FILES = "include", "read_data", "read_restart", "jump"     # the first word is a file
READERS = *FILES, "molecule", "region", "pair_coeff"
RUNS = "run", "minimize", "rerun"
DIGITS = "thermo_modify   line one format float %.12g"


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

    def measuring(self, measures):
        """The script with `step time <measures>` as the last columns of thermo output."""
        columns = " ".join(["step time", *measures])
        lines = [self.placed(line) for line in self.lines]
        first = [line.split()[:2] for line in lines]
        styles = [n for n, words in enumerate(first) if words == ["thermo_style", "custom"]]
        runs = [n for n, words in enumerate(first) if words[:1] and words[0] in RUNS]
        if styles:
            lines[styles[-1]] = lines[styles[-1]].split("#")[0] + " " + columns
        for n in reversed(runs):
            new = n == runs[0] and not styles
            lines[n:n] = [f"thermo_style    custom {columns}"] * new + [DIGITS]
        return "\n".join(lines) + "\n"
