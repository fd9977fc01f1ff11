"""Networks of tubes: read from two tables, and their surface.

A tube has round ends about its nodes. Where tubes meet in a node the edge between them is rounded,
by the more the sharper it is; tubes that go on straight with one radius stay a tube.
"""
import csv
from itertools import combinations
from typing import NamedTuple

import numpy as np

import surface_nets
from rbc.errors import InputError

ROUNDED = 0.5    # of the narrower tube's radius: distances that differ by less are rounded
CHUNK = 4096     # points whose distances are found at once


class Network(NamedTuple):
    nodes: np.ndarray       # (nodes, 3)
    segments: np.ndarray    # (segments, 2): numbers of nodes, from 0
    radii: np.ndarray       # of the segments
    names: tuple            # of the nodes

    def corners(self):
        """Of a box around it."""
        widest = self.radii.max()
        return self.nodes.min(axis=0) - widest, self.nodes.max(axis=0) + widest

    def extent(self):
        """Of this box."""
        lowest, highest = self.corners()
        return highest - lowest

    def lengths(self):
        """Of the segments, from node to node."""
        return np.linalg.norm(np.diff(self.nodes[self.segments], axis=1)[:, 0], axis=1)


def read_network(nodes_path, segments_path):
    """From CSV files with the columns node, x, y, z, and from, to, radius; others are not read."""
    numbers, places = {}, []
    for line, (name, *place) in rows(nodes_path, ("node", "x", "y", "z")):
        if name in numbers:
            raise InputError(f"{nodes_path}, line {line}: there is a node {name} already")
        numbers[name] = len(places)
        places.append([number(word, nodes_path, line) for word in place])
    segments, radii = [], []
    for line, (start, end, radius) in rows(segments_path, ("from", "to", "radius")):
        for name in (start, end):
            if name not in numbers:
                raise InputError(f"{segments_path}, line {line}: {nodes_path} has no node {name}")
        segments.append([numbers[start], numbers[end]])
        radii.append(number(radius, segments_path, line))
        if not radii[-1] > 0:
            raise InputError(f"{segments_path}, line {line}: the radius {radius} must be > 0")
    network = Network(np.array(places), np.array(segments), np.array(radii), tuple(numbers))
    check(network, nodes_path, segments_path)
    return network


def rows(path, columns):
    """(line, values of the columns) of each row."""
    with open(path, newline="", encoding="utf-8-sig") as file:
        reader = csv.DictReader(file, skipinitialspace=True)
        missing = [name for name in columns if name not in (reader.fieldnames or ())]
        if missing:
            raise InputError(f"{path}: its first line must name the columns {', '.join(columns)}; "
                             f"it has no {', '.join(missing)}")
        table = [(reader.line_num, [(row[name] or "").strip() for name in columns])
                 for row in reader]
    if not table:
        raise InputError(f"{path} has no rows")
    return table


def number(word, path, line):
    try:
        value = float(word)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise InputError(f"{path}, line {line}: '{word}' is not a number")
    return value


def check(network, nodes_path, segments_path):
    unused = set(range(len(network.nodes))) - set(network.segments.ravel())
    if unused:
        raise InputError(f"{nodes_path}: no segment has the node {network.names[min(unused)]}")
    seen = set()
    for pair, length in zip(network.segments, network.lengths()):
        names = " and ".join(network.names[node] for node in pair)
        if not length > 0:
            raise InputError(f"{segments_path}: the segment between {names} has no length")
        if frozenset(pair) in seen:
            raise InputError(f"{segments_path}: there are two segments between {names}")
        seen.add(frozenset(pair))


class Distance:
    """Signed distance from the surface of a network, below zero inside; exact to one radius from
    it, but for rounded edges."""

    def __init__(self, network):
        self.starts, ends = network.nodes[network.segments].transpose(1, 0, 2)
        self.ways = ends - self.starts
        self.radii = network.radii
        self.lowest = np.minimum(self.starts, ends) - 2 * self.radii[:, None]
        self.highest = np.maximum(self.starts, ends) + 2 * self.radii[:, None]
        self.joined = {(i, j) for i, j in combinations(range(len(network.radii)), 2)
                       if set(network.segments[i]) & set(network.segments[j])}

    def __call__(self, points):
        chunks = np.split(points, range(CHUNK, len(points), CHUNK))
        return np.concatenate([self.near(chunk) for chunk in chunks])

    def near(self, points):
        """Of points, by the tubes that are near one of them."""
        low, high = points.min(axis=0), points.max(axis=0)
        tubes = np.flatnonzero(((self.lowest <= high) & (self.highest >= low)).all(axis=1))
        result = np.full(len(points), self.radii.min())
        found = {}
        for tube in tubes:
            found[tube] = self.from_tube(tube, points)
            np.minimum(result, found[tube][0], out=result)
        for pair in combinations(tubes, 2):
            if pair in self.joined:
                reach = ROUNDED * self.radii[list(pair)].min()
                np.minimum(result, rounded(*(found[tube] for tube in pair), reach), out=result)
        return result

    def from_tube(self, tube, points):
        """Distances and their gradients."""
        way = self.ways[tube]
        along = np.clip((points - self.starts[tube]) @ way / (way @ way), 0, 1)
        off = points - self.starts[tube] - along[:, None] * way
        size = np.linalg.norm(off, axis=1)
        return size - self.radii[tube], off / np.maximum(size, 1e-9 * self.radii[tube])[:, None]


def rounded(first, second, reach):
    """The lesser of two distances, less near the edge where both are alike; their gradients tell
    how sharp it is."""
    (a, to_a), (b, to_b) = first, second
    nearer = np.maximum(1 - np.abs(a - b) / reach, 0)
    sharpness = ((1 - (to_a * to_b).sum(axis=1)) / 2)**2
    return np.minimum(a, b) - nearer**2 * sharpness * reach / 4


def surface(network, edge):
    """Points and triangles of the closed surface of a network."""
    points, triangles = surface_nets.surface_of(Distance(network), *network.corners(), edge)
    expected = 2 * (len(network.nodes) - len(network.segments))    # pieces less loops, twice
    if (not surface_nets.is_closed(triangles)
            or surface_nets.euler_characteristic(triangles) != expected):
        raise InputError(f"with --edge {edge:g} the surface is not that of the network: tubes "
                         "touch that have no node in common, or triangles are too large for the "
                         "narrowest tube; move tubes apart, or make --edge smaller")
    return points, triangles
