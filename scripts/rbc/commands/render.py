"""Render the closed surfaces of a .vtp or .pvtp file to a PNG, without a display.

  %(prog)s cells.1000.vtp -o cells.png --box 0 32 0 32 0 24 --plates --scale-bar 8
  %(prog)s cells.1000.pvtp -o cells.png --color tension --view 30 20
  %(prog)s cells.1000.vtp -o cells.png --walls vessel.stl --flow velocity.1000.vtr

Lengths are in the unit of the file. The view is from azimuth A (degrees from -y towards +x) and
elevation E above the x-y plane: `--view 0 0` sees x to the right and z up.

`python3 -m rbc movie` draws any number of files and writes a movie; so does --movie here, with its
options.

Needs the Debian packages python3-vtk9, python3-numpy and xvfb: VTK draws through an X server, and
the script starts a private Xvfb for as long as it runs. Without Xvfb it uses $DISPLAY.
"""
import sys

from rbc import command_line
from rbc.commands import movie
from rbc.commands.look_options import add_look, parse_look
from rbc.rendering import render


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("surface", help=".vtp or .pvtp file")
    parser.add_argument("-o", "--output", required=True, help="PNG to write")
    parser.add_argument("--flow", metavar="FILE",
                        help="draw a slice of the velocity in this file of dump grid/vtk or grid")
    parser.add_argument("--movie", action="store_true",
                        help="write a movie of all files named: see `python3 -m rbc movie --help`")
    add_look(parser)
    return parse_look(parser, arguments)


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    if "--movie" in arguments:
        movie.main([word for word in arguments if word != "--movie"])
        return
    args, look = parse(arguments)
    render(args.surface, args.output, look)
