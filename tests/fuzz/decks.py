#!/usr/bin/python3
"""Mutates decks, runs each on 1 and 2 MPI tasks, and lists those that end as no run may.

A run may end well or with an error of LAMMPS. Findings are: a signal, a report of a sanitizer, no
end within the time limit, an exception that is no error of LAMMPS, an end without a message, and
numbers that are not finite without an error. A deck depends on --seed and its number alone:
`--seed 1 --only 1234 --keep` runs one again and leaves its folder.

    /usr/bin/python3 tests/fuzz/decks.py --count 5000 --seed 1
"""

import argparse
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "helpers"))

from deck_bases import SCRIPT, bases, shorten    # noqa: E402
from deck_mutations import mutate                # noqa: E402
from lammps_case import ENVIRONMENT, ROOT        # noqa: E402

GOOD = ("well", "error", "no memory")
SIGNALS = (signal.SIGSEGV, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGABRT)
MEMORY_MB = 4000
RETRY = 4    # a run over the time limit gets this many times as long before it counts as a hang


class Deck:
    """Deck number `number` of the sequence that belongs to a seed."""

    def __init__(self, originals, seed, number):
        random = Random(f"{seed} {number}")
        self.number = number
        self.base = random.choice(sorted(originals))
        self.files, self.changes = mutate(dict(originals[self.base]), originals, random)
        self.files[SCRIPT] = shorten(self.files[SCRIPT])

    def write(self, folder):
        for name, content in self.files.items():
            (folder / name).write_bytes(content)


def limit_resources(sanitized, core):
    # tasks on one core hand it over to each other; on a busy machine those on several wait for long
    os.sched_setaffinity(0, {core})
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if not sanitized:    # the sanitizer reserves address space and has a limit of its own
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_MB << 20,) * 2)


def environment(session):
    options = f"detect_leaks=0:hard_rss_limit_mb={MEMORY_MB}:max_allocation_size_mb={MEMORY_MB}"
    return {**os.environ, **ENVIRONMENT,
            "ASAN_OPTIONS": f"{options}:{os.environ.get('ASAN_OPTIONS', '')}",
            "OMPI_MCA_orte_tmpdir_base": session,
            "OMPI_MCA_ess_singleton_isolated": "1"}    # one task needs no daemon of MPI


def end_all(process):
    """Ends what the process has started, too."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, number)
        except ProcessLookupError:
            break
        try:
            process.wait(2)
        except subprocess.TimeoutExpired:
            pass
    process.wait()


def start(options, folder, ranks, limit, core):
    """(exit code or None, what was printed)"""
    command = [str(options.lmp), "-in", SCRIPT, "-log", "none"]
    if ranks > 1:
        command = [options.mpiexec, "-np", str(ranks), *command]
    with open(folder / f"printed.{ranks}", "w+b") as output, TemporaryDirectory() as session:
        process = subprocess.Popen(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
            env=environment(session), start_new_session=True,
            preexec_fn=lambda: limit_resources(options.sanitized, core))
        try:
            code = process.wait(limit)
        except subprocess.TimeoutExpired:
            code = None
        finally:
            end_all(process)
    return code, (folder / f"printed.{ranks}").read_text(errors="replace")


def verdict(code, printed):
    """How a run ended, in one or two words."""
    memory = re.search(r"bad_alloc|out-of-memory|allocation-size-too-big|hard rss limit|"
                       r"Failed to (re)?allocate|Cannot allocate memory", printed)
    if code is None:
        return "hang"
    if memory and code != 0:
        return "no memory"
    if re.search(r"ERROR: AddressSanitizer|runtime error:|ERROR: LeakSanitizer", printed):
        return "sanitizer"
    if (code < 0 or code - 128 in SIGNALS or
            re.search(r"exited on signal|Process received signal", printed)):
        return "signal"
    if re.search(r"^Exception:", printed, re.MULTILINE):
        return "exception"
    if code != 0:
        return "error" if re.search(r"^ERROR", printed, re.MULTILINE) else "no message"
    return "not finite" if not_finite(printed) else "well"


def not_finite(printed):
    """Whether a line of thermodynamic output holds a number that is none."""
    for table in re.findall(r"^ +Step .*?^Loop time", printed, re.MULTILINE | re.DOTALL):
        if re.search(r"(?<!\w)-?(nan|inf)(?!\w)", table):    # as LAMMPS prints them
            return True
    return False


def last_words(printed):
    """The line that says most about why a run ended."""
    for pattern in (r"^.*(?:ERROR: AddressSanitizer|runtime error:).*$", r"^ERROR.*$",
                    r"^Exception.*$",
                    r"^.*(?:Signal:|exited on signal).*$"):
        found = re.search(pattern, printed, re.MULTILINE)
        if found:
            return found.group(0).strip()[:200]
    lines = printed.strip().splitlines()
    return lines[-1][:200] if lines else ""


def try_deck(options, originals, number):
    """[(number of the deck, ranks, verdict, line)], and how often a run was given more time."""
    deck = Deck(originals, options.seed, number)
    folder = options.folder / f"deck{number}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    deck.write(folder)
    (folder / "changes").write_text(f"base: {deck.base}\n" + "\n".join(deck.changes) + "\n")
    ends = []
    cores = sorted(os.sched_getaffinity(0))
    core = cores[number % len(cores)]
    for ranks in options.ranks:
        code, printed = start(options, folder, ranks, options.limit, core)
        if code is None and not options.no_retry:
            deck.write(folder)    # the first try may have written over them
            code, printed = start(options, folder, ranks, RETRY * options.limit, core)
        ends.append((number, ranks, verdict(code, printed), f"{deck.base}: {last_words(printed)}"))
    if not options.keep and all(end[2] in GOOD for end in ends):
        shutil.rmtree(folder)
    return ends


def campaign(options):
    """Tries decks until all are done or the time is over; returns all their ends."""
    originals = bases()
    numbers = options.only or range(options.first, options.first + options.count)
    deadline = time.monotonic() + options.seconds if options.seconds else None

    def one(number):
        if deadline and time.monotonic() > deadline:
            return []
        ends = try_deck(options, originals, number)
        for end in ends:
            if end[2] not in GOOD:
                print("deck {} on {} task(s): {}: {}".format(*end), flush=True)
        return ends

    with ThreadPoolExecutor(options.jobs) as pool:
        return [end for ends in pool.map(one, numbers) for end in ends]


def report(ends):
    counts = Counter(end[2] for end in ends)
    decks = len({end[0] for end in ends})
    print(f"{decks} decks, {len(ends)} runs: " +
          ", ".join(f"{count} {word}" for word, count in counts.most_common()), flush=True)
    return [end for end in ends if end[2] not in GOOD]


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=5000, help="number of decks")
    parser.add_argument("--first", type=int, default=0, help="number of the first deck")
    parser.add_argument("--only", type=int, nargs="+",
                        help="numbers of decks, in place of --first and --count")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--seconds", type=float, help="begin no deck after this time")
    parser.add_argument("--limit", type=float, default=30, help="seconds that a run may take")
    parser.add_argument("--no-retry", action="store_true",
                        help="a run over the limit is a hang at once")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", action="store_true",
                        help="keep the folders of all decks, not only of findings")
    parser.add_argument("--folder", type=Path, default=Path("decks"),
                        help="where decks are written and run")
    parser.add_argument("--lmp", type=Path,
                        default=Path(os.environ.get("LMP_RBC", ROOT / "build" / "lmp_rbc")))
    parser.add_argument("--mpiexec", default=os.environ.get("MPIEXEC", "mpiexec"))
    options = parser.parse_args(arguments)
    options.folder = options.folder.resolve()
    options.lmp = options.lmp.resolve()
    if not options.lmp.exists():
        parser.error(f"there is no {options.lmp}; --lmp names the executable")
    options.sanitized = b"__asan_init" in options.lmp.read_bytes()
    return options


if __name__ == "__main__":
    sys.exit(1 if report(campaign(parse())) else 0)
