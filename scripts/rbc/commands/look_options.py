"""Options of the commands that draw cells."""
from rbc.actors import SUBDIVIDE_BELOW
from rbc.rendering import MICRON, Look


def size(text):
    width, height = (int(side) for side in text.split("x"))
    if min(width, height) < 16:
        raise ValueError
    return width, height


def add_look(parser):
    parser.add_argument("--color", metavar="ARRAY",
                        help="point data to color by: molecule, aggregate, velocity, tension, ...")
    parser.add_argument("--range", type=float, nargs=2, metavar=("LOW", "HIGH"),
                        help="limits of the colours (default: of the data)")
    parser.add_argument("--label", help="title of the colour bar (default: the array's name)")
    parser.add_argument("--size", type=size, default=(1280, 960), metavar="WxH")
    parser.add_argument("--box", type=float, nargs=6,
                        metavar=("XLO", "XHI", "YLO", "YHI", "ZLO", "ZHI"),
                        help="draw this outline and fit the view to it")
    parser.add_argument("--plates", action="store_true", help="draw the z faces of --box as walls")
    parser.add_argument("--walls", nargs="+", default=(), metavar="STL",
                        help="draw the far side of these vessels")
    parser.add_argument("--wall-scale", type=float, default=1.0, metavar="S",
                        help="scale of region rbc/mesh")
    parser.add_argument("--wall-shift", type=float, nargs=3, default=(0, 0, 0),
                        metavar=("X", "Y", "Z"), help="its shift")
    parser.add_argument("--slice", choices="xyz", default="y",
                        help="the slice of --flow is normal to it (default y)")
    parser.add_argument("--slice-at", type=float, metavar="PLACE",
                        help="where it is (default: in the middle)")
    parser.add_argument("--flow-range", type=float, nargs=2, metavar=("LOW", "HIGH"),
                        help="limits of the colours of the flow (default: 0 to the largest speed)")
    parser.add_argument("--view", type=float, nargs=2, default=(25, 20),
                        metavar=("AZIMUTH", "ELEVATION"), help="degrees (default 25 20)")
    parser.add_argument("--zoom", type=float, default=1.0, help="size in the picture (default 1)")
    parser.add_argument("--parallel", action="store_true", help="no perspective")
    parser.add_argument("--scale-bar", type=float, metavar="LENGTH",
                        help="draw a bar of this length; no perspective")
    parser.add_argument("--unit", default=MICRON,
                        help="unit of lengths, at the scale bar (default um, as in units micro; "
                        "with another there are no units at the color bar)")
    parser.add_argument("--smooth", type=int, default=1, metavar="N",
                        help=f"subdivisions for display, up to {SUBDIVIDE_BELOW} triangles")
    parser.add_argument("--no-occlusion", dest="occlusion", action="store_false",
                        help="no shading of narrow gaps (faster; never with --flow)")


def parse_look(parser, arguments):
    """The arguments, and the Look that they ask for."""
    args = parser.parse_args(arguments)
    if args.plates and not args.box:
        parser.error("--plates needs --box")
    return args, Look(**{name: value for name, value in vars(args).items() if name in Look._fields})
