#!/usr/bin/python3
"""Flows in the tubes of a network against those of Poiseuille's resistances, over resolution.

Runs in.network for a list of cases and writes flows.csv, with a row for each segment, and
network.png to a folder. Cases that its flows.csv already holds are not run again.

study.py --output FOLDER [--lmp ../../build/lmp_rbc] [--only resolution]
"""
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402
import example_study  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter  # noqa: E402
from rbc.grids import read_grid  # noqa: E402
from rbc.rendering import Look, render  # noqa: E402
from vessel_network import read_network, surface  # noqa: E402

FLOW, VISCOSITY = 0.02, 1.2    # of in.network
INLET, OUTLETS = "in", ("out1", "out2", "out3")
COLUMNS = ("segment", "flow", "poiseuille")
RADII, ANGLES, STATIONS = 8, 24, 8    # points of each segment at which velocities are found
STRETCH = 0.3                         # part of a segment's length, in its middle, where they lie


def cases():
    """(name of the series, label, variables) of every run."""
    for dx in (1.25, 0.9):
        yield "resolution", f"dx {dx:g}", dict(dx=dx)


def the_network():
    return read_network(HERE / "nodes.csv", HERE / "segments.csv")


def poiseuille(network):
    """Flows in the segments, from the first of their nodes to the second, where each has the
    resistance of Poiseuille's law from node to node, and the outlets have one pressure."""
    conductances = np.pi * network.radii**4 / (8 * VISCOSITY * network.lengths())
    into, out_of = network.segments.T
    ends = np.zeros((len(network.radii), len(network.nodes)))
    ends[np.arange(len(into)), into], ends[np.arange(len(into)), out_of] = 1, -1
    balance = ends.T @ (conductances[:, None] * ends)
    sources = np.where(np.array(network.names) == INLET, FLOW, 0)
    free = ~np.isin(network.names, OUTLETS)    # in the others the pressure is 0
    pressures = np.zeros(len(network.nodes))
    pressures[free] = np.linalg.solve(balance[np.ix_(free, free)], sources[free])
    return conductances * (ends @ pressures)


def measured(network, grid):
    """The same of the flow on a grid: the mean over sections in the middle of each segment, a cell
    wider than it as the wall is blurred."""
    beyond = grid.edges[0][1] - grid.edges[0][0]
    nodes, weights = np.polynomial.legendre.leggauss(RADII)
    angles = 2 * np.pi * (np.arange(ANGLES) + 0.5) / ANGLES
    steps = STRETCH * ((np.arange(STATIONS) + 0.5) / STATIONS - 0.5)
    velocity, flows = grid.vector(), []
    for (start, end), radius in zip(network.segments, network.radii + beyond):
        way = network.nodes[end] - network.nodes[start]
        along = way / np.linalg.norm(way)
        side = np.cross(along, np.eye(3)[np.abs(along).argmin()])
        side /= np.linalg.norm(side)
        circle = np.outer(np.cos(angles), side) + np.outer(np.sin(angles), np.cross(along, side))
        r = radius * (nodes + 1) / 2
        axis = network.nodes[start] + np.multiply.outer(0.5 + steps, way)
        points = axis[:, None, None] + r[:, None, None] * circle
        speed = interpolated(velocity, grid.centres, points.reshape(-1, 3)) @ along
        means = speed.reshape(STATIONS, RADII, ANGLES).mean(axis=(0, 2))
        flows.append(np.pi * radius * (weights * r * means).sum())
    return np.array(flows)


def interpolated(values, centres, points):
    """At points, by cubic polynomials through four values in each direction."""
    places, shares = [], []
    for axis, centre in enumerate(centres):
        place = (points[:, axis] - centre[0]) / (centre[1] - centre[0])
        first = np.floor(place).astype(int)
        t = place - first
        places.append(first[:, None] + np.arange(-1, 3))
        shares.append(np.stack([-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                                -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6], axis=-1))
    i, j, k = places
    around = values[i[:, :, None, None], j[:, None, :, None], k[:, None, None, :]]
    return np.einsum("nijkc,ni,nj,nk->nc", around, *shares)


def run(arguments, variables):
    with tempfile.TemporaryDirectory() as folder:
        places = dict(tables=HERE, scripts=HERE.parents[1] / "scripts")
        done = example_study.run_script(arguments, HERE / "in.network", folder,
                                        {**variables, **places})
        done.check_returncode()
        flows = measured(the_network(), read_grid(Path(folder) / "flow.0.vtr"))
    return list(zip(range(1, len(flows) + 1), flows, poiseuille(the_network())))


def imbalance(network, flows):
    """Of the nodes within the network: the largest part of FLOW that is lost in one."""
    into, out_of = network.segments.T
    count = len(network.nodes)
    sums = np.bincount(into, flows, count) - np.bincount(out_of, flows, count)
    within = np.bincount(network.segments.ravel()) > 1
    return np.abs(sums[within]).max() / FLOW


def report(table):
    network = the_network()
    for label, rows in table.items():
        flows, laws = rows[:, 1], rows[:, 2]
        print(f"\n{label}: segment, radius, length, flow, Poiseuille, difference of the inlet's "
              "flow and of its own")
        for (number, flow, law), radius, length in zip(rows, network.radii, network.lengths()):
            print(f"{number:3.0f} {radius:5.1f} {length:6.1f} {flow / FLOW:8.4f} {law / FLOW:8.4f} "
                  f"{(flow - law) / FLOW:+8.2%} {flow / law - 1:+8.2%}")
        away = (flows - laws) / FLOW
        print(f"of the inlet's flow: rms {np.sqrt((away**2).mean()):.2%}, largest "
              f"{np.abs(away).max():.2%}, lost in a node {imbalance(network, flows):.2%}")


def draw(network, flows, path):
    """The surface, colored by the flow of the nearest segment."""
    points, triangles = surface(network, 0.8)
    starts, ways = (network.nodes[network.segments[:, 0]],
                    np.diff(network.nodes[network.segments], axis=1)[:, 0])
    nearest, least = np.zeros(len(points), dtype=int), np.full(len(points), np.inf)
    for segment, (start, way) in enumerate(zip(starts, ways)):
        along = np.clip((points - start) @ way / (way @ way), 0, 1)
        off = np.linalg.norm(points - start - along[:, None] * way, axis=1) - network.radii[segment]
        nearest[off < least] = segment
        least = np.minimum(least, off)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "network.vtp"
        write_surface(file, points, triangles, "flow", 100 * flows[nearest] / FLOW)
        render(file, path,
               Look(color="flow", label="flow, % of the inlet's", view=(0, 90), size=(1200, 560),
                    parallel=True, scale_bar=50, range=(0, 100)))


def write_surface(path, points, triangles, name, values):
    data, vertices, polygons = vtkPolyData(), vtkPoints(), vtkCellArray()
    vertices.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    polygons.SetData(3, numpy_to_vtkIdTypeArray(
        np.ascontiguousarray(triangles.ravel(), dtype=np.int64), deep=True))
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    data.SetPoints(vertices)
    data.SetPolys(polygons)
    data.GetPointData().AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.Write()


def main():
    arguments = command_line.parse(
        example_study.options(__doc__, [series for series, _, _ in cases()]), HERE)
    table = example_study.run_cases(arguments, arguments.output / "flows.csv", COLUMNS, cases(),
                                    run)
    report(table)
    if arguments.only is None:
        finest = list(table.values())[-1]
        draw(the_network(), finest[:, 1], arguments.output / "network.png")


if __name__ == "__main__":
    main()
