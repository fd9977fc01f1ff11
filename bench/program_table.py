"""The command line of the benchmarks that draw the table that a program prints."""
import subprocess
from pathlib import Path

from rbc import command_line

HERE = Path(__file__).resolve().parent


def folder_with(name, description):
    """The folder asked for, in which <name>.csv is what the program has printed.

    Without a program it is the table that was there before.
    """
    parser = command_line.parser(description)
    command_line.add_results(parser)
    parser.add_argument("--program", type=Path,
                        help=f"build/{name}, which measures; without it {name}.csv is only drawn")
    arguments = command_line.parse(parser, HERE)
    if arguments.program:
        done = subprocess.run([arguments.program.resolve()], check=True, text=True,
                              stdout=subprocess.PIPE)
        (arguments.output / f"{name}.csv").write_text(done.stdout, encoding="utf-8")
    return arguments.output
