"""The commands of `python3 -m rbc`."""
import importlib
import sys

from rbc import command_line

PROGRAM = "python3 -m rbc"
COMMANDS = {
    "csv": "tables of a run as CSV: cell.dat, logs, measures of surfaces",
    "render": "a picture of cells, with walls and a slice of the flow",
    "movie": "pictures of a series of files of cells as a movie",
    "plot": "deformation and angles of cells in shear over time",
    "motion": "tumbling and tank-treading of a cell, from a dump of its vertices",
    "statistics": "distances, order and paths of many cells",
    "aggregates": "sizes of aggregates over time or the shear rate",
    "gaps": "gaps between the surfaces of neighboring cells",
}


def listing():
    rows = "\n".join(f"  {name:<11} {what}" for name, what in COMMANDS.items())
    return (f"usage: {PROGRAM} COMMAND ...\n\n{rows}\n\n"
            f"{PROGRAM} COMMAND --help lists its options. In Python, import rbc and see\n"
            "help(rbc).")


def main(words):
    if not words or words[0] in ("-h", "--help"):
        print(listing())
        return
    name, *arguments = words
    if name not in COMMANDS:
        command_line.stop(PROGRAM, f"there is no command {name}; there are {', '.join(COMMANDS)}")
    sys.argv[0] = f"{PROGRAM} {name}"
    importlib.import_module(f"rbc.commands.{name}").main(arguments)


if __name__ == "__main__":
    main(sys.argv[1:])
