"""A movie of the surfaces of cells: a picture of each file, in order of the steps in their names.

  python3 -m rbc movie cells.*.vtp -o cells.gif --box 0 24 0 24 0 24 --plates
  python3 -m rbc movie cells.*.vtp -o cells.mp4 --walls vessel.stl --flow velocity.*.vtr

The name says how it is written: .gif and .png (an animated PNG) need python3-pil, which comes with
matplotlib; .mp4, .webm and .mkv need the Debian package ffmpeg. Colors and view are the same in all
pictures. Each file of --flow serves the cells of its step and of those up to the next.
"""
from rbc import command_line
from rbc.commands.look_options import add_look, parse_look
from rbc.movies import write_movie


def parse(arguments):
    parser = command_line.parser(__doc__)
    parser.add_argument("surfaces", nargs="+", help=".vtp or .pvtp files")
    parser.add_argument("-o", "--output", required=True, help="movie to write")
    parser.add_argument("--rate", type=float, default=10, metavar="N",
                        help="pictures a second (default 10)")
    parser.add_argument("--flow", nargs="+", default=(), metavar="FILE", dest="flows",
                        help="draw a slice of the velocity in files of dump grid/vtk or grid")
    add_look(parser)
    return parse_look(parser, arguments)


def main(arguments=None):
    args, look = parse(arguments)
    write_movie(args.surfaces, args.output, look, args.flows, args.rate)
