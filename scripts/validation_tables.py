"""Tables of the repository and numbers as doc/validation.rst has them."""
import csv
import importlib.util
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES, BENCH = ROOT / "examples", ROOT / "bench"


class Number(float):
    """Formatted as `3` to that many significant digits, as `+3` with its sign."""

    def __format__(self, form):
        if not re.fullmatch(r"\+?[1-9]", form):
            raise ValueError(f"{form!r} is not a number of digits, as 2 or +2")
        sign, digits = form[:-1], form[-1]
        text = f"{float(self):{sign}#.{digits}g}"
        if "e+" in text:    # more digits before the point than asked for
            text = f"{float(text):{sign}.0f}"
        return re.sub(r"\.(?=e|$)", "", text).replace("e-0", "e-")


class Figures:
    """Numbers and words by name, some for each of several things."""

    def __init__(self, **values):
        for name, value in values.items():
            setattr(self, name, made(value))


def made(value):
    if isinstance(value, (str, Figures)):
        return value
    if isinstance(value, dict):
        return {key: made(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [made(one) for one in value]
    return Number(value)


def rows(path):
    """Of a CSV under the top folder, numbers as such."""
    def converted(word):
        try:
            return float(word)
        except ValueError:
            return word
    with open(ROOT / path, encoding="utf-8") as file:
        lines = (line for line in file if not line.startswith("#"))
        return [{name: converted(word) for name, word in row.items()}
                for row in csv.DictReader(lines)]


def chosen(path, **wanted):
    """The rows that have these values."""
    found = [row for row in rows(path)
             if all(row[name] == value for name, value in wanted.items())]
    if not found:
        raise ValueError(f"{path} has no row with {wanted}")
    return found


def one(path, **wanted):
    row, = chosen(path, **wanted)
    return row


def script(path):
    """A script under the top folder as a module: its closed forms, references and readers.
    Its neighbours are found, whatever names others have for theirs."""
    path = ROOT / path
    sys.path.insert(0, str(path.parent))
    sys.modules.pop("study", None)
    try:
        specification = importlib.util.spec_from_file_location(
            f"{path.parent.name}_{path.stem}", path)
        module = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(module)
    finally:
        sys.path.remove(str(path.parent))
        sys.modules.pop("study", None)
    return module


def study(example):
    return script(f"examples/{example}/study.py")


def bench_times():
    """What each script of bench takes, as its README says."""
    text = (BENCH / "README.md").read_text(encoding="utf-8")
    return dict(re.findall(r"^\| `(\w+)\.(?:sh|py)[^|]*\|[^|]*\| ([^|]*?) \|$", text,
                           re.MULTILINE))


def minutes(seconds):
    return f"{seconds / 60:.0f} min" if seconds >= 90 else f"{seconds:.0f} s"
