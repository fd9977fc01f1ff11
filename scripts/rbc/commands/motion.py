"""The command of rbc.membrane_motion."""
from rbc import command_line
import numpy as np

from rbc import membrane_motion
from rbc.membrane_motion import angles, mean_motion, read_dump

USAGE = "%(prog)s vertices.dump --timestep DT --shear-rate G [-o motion.dat] [--from STRAIN]"


def main(arguments=None):
    parser = command_line.parser(f"{membrane_motion.__doc__}\n{USAGE}")
    parser.add_argument("dump")
    parser.add_argument("--timestep", type=float, required=True)
    parser.add_argument("--shear-rate", type=float, required=True,
                        help="per unit of time of the timestep")
    parser.add_argument("--from", dest="start", type=float, default=5.0,
                        help="strain from which to average")
    parser.add_argument("-o", "--output",
                        help="table of strain, theta_shape and phi_membrane in degrees")
    arguments = parser.parse_args(arguments)

    steps, positions = read_dump(arguments.dump)
    strain = steps * arguments.timestep * arguments.shear_rate
    shape, membrane = angles(positions)
    if arguments.output:
        wrapped = (np.degrees(shape) + 90) % 180 - 90
        np.savetxt(arguments.output, np.column_stack([strain, wrapped, np.degrees(membrane)]),
                   header="strain theta_shape phi_membrane", fmt="%.6g")
    mean = mean_motion(strain, positions, arguments.start)
    print(f"strain {mean['from']:.3g} to {mean['to']:.3g}: shape turns at {mean['shape']:+.4f}, "
          f"membrane at {mean['membrane']:+.4f} of the shear rate; "
          f"tank-treading {mean['membrane'] - mean['shape']:+.4f}; "
          f"angle of the shape to strain {strain[-1]:.3g}: {mean['least']:.1f} to "
          f"{mean['largest']:.1f} degrees")
    turns = mean["revolutions"]
    print(f"vertices go around {turns.mean():+.4f} times per strain, "
          f"standard deviation {turns.std():.4f} over {turns.size} vertices")
