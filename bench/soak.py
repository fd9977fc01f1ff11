#!/usr/bin/python3
"""Dense blood for hours in pieces of 200 steps, with dumps, surfaces and restart files (in.soak),
in several processes one after the other: does memory grow, do cells keep their volume?

Each process but the first continues from the restart file that the one before it wrote last. Writes
soak.csv to the folder, a row per sample: resident memory of each rank, steps and time of blood so
far, the largest change of the volume of a cell in the last piece, steps taken again and steps gone
wrong so far, bytes written. The runs stay in its folder runs. Ends with 1 if a process failed or
did not go on where the one before it had ended, or if memory grew by more than --growth. The
executables come from the environment (LMP_RBC, MPIEXEC), as in soak.sh.
"""
import csv
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scripts"))
from rbc import command_line  # noqa: E402
import example_study  # noqa: E402
import numpy as np  # noqa: E402

SETTLED = 0.25      # part of the steps of a process in which lists and buffers find their size
FAR_APART = 1e-9    # of volumes and energies where a process goes on, relative
MB = 1024**2


class State:
    """A line of in.soak after each piece."""

    def __init__(self, words):
        self.step = int(words[0])
        self.time, self.smallest, self.largest, self.energy = map(float, words[1:5])
        self.again, self.wrong = (int(float(word)) for word in words[5:])

    def change(self, volume):
        """Of the cell whose volume changed most, relative."""
        return max(self.largest / volume - 1, 1 - self.smallest / volume)

    def apart(self, other):
        """How far from another state, relative; infinite where the steps differ."""
        if self.step != other.step:
            return float("inf")
        pairs = [(getattr(self, name), getattr(other, name))
                 for name in ("time", "smallest", "largest", "energy")]
        return max(abs(mine - yours) / max(abs(yours), 1e-300) for mine, yours in pairs)


def states(log):
    """Those that a log holds so far."""
    try:
        text = Path(log).read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        return []
    found = re.findall(r"^state (\S+(?: \S+){6})\n", text, re.MULTILINE)
    return [State(words.split()) for words in found]


def sums(pieces):
    """Steps that pieces took again, and those of them that had gone wrong."""
    return sum(state.again for state in pieces), sum(state.wrong for state in pieces)


def resident(process):
    """Memory of a process in MB."""
    status = Path(f"/proc/{process}/status").read_text(encoding="utf-8", errors="replace")
    found = re.search(r"^VmRSS:\s+(\d+) kB", status, re.MULTILINE)
    return int(found.group(1)) / 1024 if found else 0


def ranks_below(parent, name):
    """Processes with the name that come from the parent, in the order in which they started."""
    parents = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            text = (folder / "stat").read_text(encoding="utf-8", errors="replace")
        except OSError:
            continue    # it has ended
        head, tail = text.rsplit(")", 1)
        parents[int(folder.name)] = int(tail.split()[1]), head.split("(", 1)[1]

    def descends(process):
        while process in parents and process != parent:
            process = parents[process][0]
        return process == parent

    return sorted(process for process, (_, command) in parents.items()
                  if command == name[:15] and descends(process))


def bytes_in(folder):
    return sum(path.stat().st_size for path in folder.iterdir() if path.is_file())


def newest_restart(folder):
    return max(folder.glob("soak.restart.*"), key=lambda path: path.stat().st_mtime_ns).name


class Soak:
    """The processes of a soak, one after the other, and the samples taken of them."""

    def __init__(self, arguments):
        self.arguments, self.folder = arguments, arguments.output / "runs"
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()
        self.begin, self.rows = time.monotonic(), []
        self.ends = []    # the states of each process
        self.columns = ["process", "s", *(f"rank_{rank}_MB" for rank in range(arguments.ranks)),
                        "step", "time", "volume_change", "again", "wrong", "output_MB"]

    def command(self, number):
        variables = {name: getattr(self.arguments, name)
                     for name in ("steps", "frames", "length", "gap")}
        variables["templates"] = example_study.POTENTIALS
        if number:
            variables |= {"continued": 1, "restart": newest_restart(self.folder)}
        command = [os.environ["MPIEXEC"], "-n", str(self.arguments.ranks), os.environ["LMP_RBC"],
                   "-in", HERE / "in.soak", "-log", f"log.{number}", "-screen", "none"]
        for name, value in variables.items():
            command += ["-var", name, str(value)]
        return command

    def say_go(self, on):
        """Whether another piece follows; the file is never there in part."""
        (self.folder / "go.new").write_text(f"{int(on)}\n", encoding="ascii")
        os.replace(self.folder / "go.new", self.folder / "go")

    def sample(self, process, number):
        """A row of the table, if the process has come far enough; reads its log."""
        now = states(self.folder / f"log.{number}")
        ranks = ranks_below(process.pid, Path(os.environ["LMP_RBC"]).name)
        try:
            memory = [resident(rank) for rank in ranks]
        except FileNotFoundError:
            return    # it has ended since
        if not now or len(ranks) != self.arguments.ranks:
            return
        volume = (self.ends[0] if self.ends else now)[0].largest
        before = [state for ended in self.ends for state in ended]
        again, wrong = sums(before + now)
        self.rows.append([number, time.monotonic() - self.begin, *memory, now[-1].step,
                          now[-1].time, now[-1].change(volume), again, wrong,
                          bytes_in(self.folder) / MB])
        self.write()

    def write(self):
        with open(self.arguments.output / "soak.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self.columns)
            writer.writerows([f"{value:.8g}" for value in row] for row in self.rows)

    def run_process(self, number):
        """Until its share of the time is over and it has run a piece; returns whether it ended
        well."""
        end = self.begin + (number + 1) * self.arguments.seconds / self.arguments.processes
        self.say_go(True)
        with subprocess.Popen(self.command(number), cwd=self.folder,
                              stdin=subprocess.DEVNULL) as process:
            while process.poll() is None:
                left = end - time.monotonic()
                if left <= 0 and len(states(self.folder / f"log.{number}")) > 1:
                    self.say_go(False)
                try:
                    process.wait(min(self.arguments.every, left) if left > 0 else 0.2)
                except subprocess.TimeoutExpired:
                    if left > 0:
                        self.sample(process, number)
        self.ends.append(states(self.folder / f"log.{number}"))
        return process.returncode == 0 and len(self.ends[-1]) > 1

    def run(self):
        """Returns how many processes ended well."""
        for number in range(self.arguments.processes):
            if not self.run_process(number):
                print(f"process {number} failed: {self.folder / f'log.{number}'}")
                return number
        return self.arguments.processes

    def joints(self):
        """How far apart the end of each process and the beginning of the next are, relative."""
        return [after[0].apart(before[-1])
                for before, after in zip(self.ends, self.ends[1:]) if before and after]

    def growth(self):
        """Of the memory of each rank in each process, MB per hour and MB in all, of the line
        through its samples once it has settled."""
        found = []
        table = np.array(self.rows, dtype=float).reshape(-1, len(self.columns))
        for number in np.unique(table[:, 0]):
            mine = table[table[:, 0] == number]
            steps = mine[:, self.columns.index("step")]
            mine = mine[steps > steps[0] + SETTLED * np.ptp(steps)]
            if len(mine) < 3:
                continue
            for rank in range(self.arguments.ranks):
                slope = np.polyfit(mine[:, 1], mine[:, 2 + rank], 1)[0]
                found.append((3600 * slope, slope * np.ptp(mine[:, 1])))
        return found


def report(soak, well):
    """Prints what was found; returns whether all of it is as it should be."""
    pieces = [state for ended in soak.ends for state in ended]
    joints, growth = soak.joints(), soak.growth()
    largest = max((total for _, total in growth), default=float("nan"))
    print(f"processes: {well} of {soak.arguments.processes} ended well, "
          f"with {sum(len(ended[1:]) for ended in soak.ends)} pieces")
    if pieces:
        steps, blood = pieces[-1].step, pieces[-1].time
        again, wrong = sums(pieces)
        print(f"steps: {steps} ({blood:.6g} us of blood), taken again {again}, "
              f"of these {wrong} had gone wrong")
        change = max(state.change(pieces[0].largest) for state in pieces)
        print(f"largest change of the volume of a cell: {change:.2g}")
    if joints:
        well_joined = sum(apart < FAR_APART for apart in joints)
        print(f"went on from restart files: {well_joined} of {len(joints)}, "
              f"volumes and energies within {max(joints):.2g}")
    if growth:
        print(f"memory of a rank grew by {max(growth)[0]:.3g} MB per hour at most, "
              f"by {largest:.3g} MB in a process")
    print(f"output: {bytes_in(soak.folder) / MB:.4g} MB")
    return (well == soak.arguments.processes and len(joints) == well - 1
            and all(apart < FAR_APART for apart in joints) and not largest > soak.arguments.growth)


def main():
    parser = command_line.parser(__doc__)
    command_line.add_results(parser)
    for name, kind, default, text in (
            ("ranks", int, 2, "of MPI"),
            ("seconds", float, 7200, "of wall time in all"),
            ("processes", int, 4, "one after the other"),
            ("every", float, 30, "seconds between samples"),
            ("steps", int, 200, "of a piece"),
            ("frames", int, 1000, "steps between frames"),
            ("length", float, 20, "of the box, um"),
            ("gap", float, 16, "between the plates, um"),
            ("growth", float, 1, "MB that a process may grow by once its memory has settled")):
        parser.add_argument(f"--{name}", type=kind, default=default,
                            help=f"{text}, default {default}")
    arguments = command_line.parse(parser, HERE, ["LMP_RBC", "MPIEXEC"])
    soak = Soak(arguments)
    sys.exit(not report(soak, soak.run()))


if __name__ == "__main__":
    main()
