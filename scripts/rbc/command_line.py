"""What scripts share: options, the folder for results, what they say where something is missing.

A script imports this before modules that do not come with Python.
"""
import argparse
import os
import subprocess
import sys
from pathlib import Path

from rbc.errors import InputError

DEBIAN = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib",
          "vtkmodules": "python3-vtk9", "PIL": "python3-pil"}
LINES = 5    # of what a failed program printed


def explanation(error):
    """One line for what a user can mend; None for a fault of the script."""
    module = (getattr(error, "name", None) or "").split(".")[0]
    if isinstance(error, ImportError) and module in DEBIAN:
        return (f"needs the Python module {module}, which {sys.executable} does not have; "
                f"on Debian apt-get install {DEBIAN[module]} gives it to /usr/bin/python3")
    if isinstance(error, InputError):
        return str(error)
    if isinstance(error, OSError) and error.filename is not None:
        return f"{os.fsdecode(error.filename)}: {error.strerror}"
    if isinstance(error, subprocess.CalledProcessError):
        program = error.cmd if isinstance(error.cmd, (str, os.PathLike)) else error.cmd[0]
        printed = (error.stdout or "") + (error.stderr or "")
        last = printed.splitlines()[-LINES:]
        return "\n".join([f"{program} ended with {error.returncode}", *last])
    return None


def explain(kind, error, trace):
    """Takes the place of a traceback."""
    if kind is BrokenPipeError:    # what reads the output, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return
    text = explanation(error)
    if text is None:
        sys.__excepthook__(kind, error, trace)
    else:
        print(f"{os.path.basename(sys.argv[0])}: {text}", file=sys.stderr)


sys.excepthook = explain


def stop(program, text):
    """Ends with what is wrong with the command line."""
    print(f"{program}: {text}", file=sys.stderr)
    raise SystemExit(2)


def default_executable():
    """What was built, or if nothing was, what was installed with this script."""
    top = Path(__file__).resolve().parents[2]
    built, installed = top / "build" / "lmp_rbc", top.parents[1] / "bin" / "lmp_rbc"
    return str(installed if installed.exists() and not built.exists() else built)


def parser(description):
    """A parser of options that must be spelt out: a new one cannot change what a command means."""
    return argparse.ArgumentParser(
        prog=os.path.basename(sys.argv[0]), description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)


def add_results(options):
    """The options that say where results go; parse() reads them."""
    where = options.add_mutually_exclusive_group()
    where.add_argument("-o", "--output", type=Path, metavar="FOLDER",
                       help="for tables and pictures, made if it is not there")
    where.add_argument("--update", action="store_true",
                       help="write over the tables and pictures that belong to the repository")


def parse(options, home, environment=()):
    """The arguments, with `output` a folder that is there.

    `home`, where the repository keeps its own results, is that folder with --update only.
    `environment`: variables that must name executables.
    """
    arguments = options.parse_args()
    for name in environment:
        if not os.access(os.environ.get(name, ""), os.X_OK):
            options.error(f"the environment variable {name} must name an executable, as in "
                          f"{options.prog[:-3]}.sh")
    if not arguments.update and arguments.output is None:
        options.error("say where results go: --output FOLDER, or --update to write over those of "
                      "the repository")
    home = Path(home).resolve()
    output = home if arguments.update else arguments.output.resolve()
    if output == home and not arguments.update:
        options.error(f"--output {arguments.output} holds the tables and pictures of the "
                      "repository: --update writes over them")
    if not getattr(arguments, "draw", False):
        check_executable(options, arguments)
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        options.error(f"--output {arguments.output}: {problem.strerror}")
    if not os.access(output, os.W_OK):
        options.error(f"--output {output} cannot be written")
    arguments.output = output
    return arguments


def check_executable(options, arguments):
    """Of --lmp, if the script has that option."""
    executable = getattr(arguments, "lmp", None)
    if executable is not None and not os.access(executable, os.X_OK):
        options.error(f"--lmp {executable} is not an executable; scripts/build.sh makes "
                      "build/lmp_rbc")


def kept(folder, home, name):
    """Path of a table in a folder, or where it has none that of the repository."""
    return Path(folder) / name if (Path(folder) / name).exists() else Path(home) / name
