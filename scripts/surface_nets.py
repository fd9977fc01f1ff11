"""Closed surfaces of well-shaped triangles: where a signed distance is zero, by surface nets.

Each cell of a grid in which the sign changes has a vertex, each side of cells at whose ends the
signs differ has two triangles. Vertices are then moved along the surface to the means of their
neighbors, which evens triangles out, and onto it.
"""
from itertools import combinations

import numpy as np

BLOCK = 16      # points of the grid along each side of what is evaluated at once
ROUNDS = 15     # of moves along the surface
NEWTON = 4      # steps onto it at the end
NEAREST = 0.1   # of a spacing, to points of the grid: vertices of several cells would lie on one


def surface_of(distance, lowest, highest, edge):
    """Points and triangles, right-handed seen from outside, of the surface of a solid that lies
    between two corners. `distance(points)` is below zero inside, and exact near the surface."""
    lowest, highest = np.asarray(lowest) - 2 * edge, np.asarray(highest) + 2 * edge
    counts = np.ceil((highest - lowest) / edge).astype(int) + 1
    origin = (lowest + highest - edge * (counts - 1)) / 2
    points, squares = net(without_crossings(sampled(distance, origin, counts, edge)))
    return evened(origin + edge * points, squares, distance)


def sampled(distance, origin, counts, edge):
    """At the points of a grid."""
    values = np.empty(counts)
    for first in np.ndindex(*-(-counts // BLOCK)):
        axes = [np.arange(BLOCK * n, min(BLOCK * (n + 1), count))
                for n, count in zip(first, counts)]
        places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        found = distance(origin + edge * places.reshape(-1, 3))
        values[np.ix_(*axes)] = found.reshape(places.shape[:-1])
    return values


def without_crossings(values):
    """The same with some values turned negative, the smallest that do, so that no square of the
    grid has one sign at the ends of one diagonal and the other at those of the other: there two
    sheets of the surface would cross."""
    steps = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    found = True
    while found:
        found = False
        for across in combinations(range(3), 2):
            first = np.moveaxis(values, across, (0, 1))
            size = np.array(first.shape[:2]) - 1
            corners = np.stack([first[i:i + size[0], j:j + size[1]] for i, j in steps])
            signs = corners < 0
            crossed = (signs[0] == signs[2]) & (signs[1] == signs[3]) & (signs[0] != signs[1])
            i, j, k = np.nonzero(crossed)
            at = corners[:, i, j, k]
            least = np.where(at < 0, np.inf, at).argmin(axis=0)
            places = i + steps[least, 0], j + steps[least, 1], k
            first[places] = -np.maximum(first[places], np.finfo(float).tiny)
            found |= len(i) > 0
    return values


def net(values):
    """Vertices, in spacings of the grid, and the four vertices around each of its sides at whose
    ends signs differ."""
    cells, crossings = [], []
    for axis in range(3):
        start, end = np.delete(values, -1, axis), np.delete(values, 0, axis)
        sides = np.argwhere((start < 0) != (end < 0))
        a, b = start[tuple(sides.T)], end[tuple(sides.T)]
        crossing = sides.astype(float)
        crossing[:, axis] += np.clip(a / (a - b), NEAREST, 1 - NEAREST)
        around = np.zeros((4, 3), dtype=int)
        around[[0, 3], (axis + 1) % 3] = around[[0, 1], (axis + 2) % 3] = -1
        four = sides[:, None] + around
        cells.append(np.where((a < 0)[:, None, None], four, four[:, ::-1]))
        crossings.append(crossing)
    squares = np.concatenate(cells)
    names = np.ravel_multi_index(squares.reshape(-1, 3).T, values.shape)
    _, squares = np.unique(names, return_inverse=True)
    crossings = np.repeat(np.concatenate(crossings), 4, axis=0)
    return scattered(squares, crossings) / np.bincount(squares)[:, None], squares.reshape(-1, 4)


def scattered(owners, vectors):
    """Sums of the vectors of each owner."""
    return np.stack([np.bincount(owners, column) for column in vectors.T], axis=-1)


def halved(points, squares):
    """Triangles of squares, cut along the shorter diagonal."""
    a, b, c, d = points[squares].transpose(1, 0, 2)
    shorter = (np.linalg.norm(a - c, axis=1) < np.linalg.norm(b - d, axis=1))[:, None, None]
    triangles = np.where(shorter, squares[:, [[0, 1, 2], [0, 2, 3]]],
                         squares[:, [[0, 1, 3], [1, 2, 3]]])
    return triangles.reshape(-1, 3)


def normals_of(points, triangles):
    """Unit vectors at the vertices."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    sums = scattered(triangles.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    return sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), np.finfo(float).tiny)


def evened(points, squares, distance):
    triangles = halved(points, squares)
    here, there = squares.ravel(), np.roll(squares, 1, axis=1).ravel()
    neighbors = np.bincount(here)[:, None]
    for _ in range(ROUNDS):
        normals = normals_of(points, triangles)
        move = scattered(here, points[there]) / neighbors - points
        move -= (move * normals).sum(axis=1, keepdims=True) * normals
        points = points + move / 2
        points = points - distance(points)[:, None] * normals
    triangles = halved(points, squares)
    normals = normals_of(points, triangles)
    for _ in range(NEWTON):
        points = points - distance(points)[:, None] * normals
    return points, triangles


def is_closed(triangles):
    """Two triangles on each edge, oriented alike."""
    count = triangles.max() + 1
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    names, times = np.unique(edges @ [count, 1], return_counts=True)
    return times.max() == 1 and np.array_equal(names, np.unique(edges[:, ::-1] @ [count, 1]))


def euler_characteristic(triangles):
    """Of a closed surface: 2 for each piece, less 2 for each of its handles."""
    return len(np.unique(triangles)) - len(triangles) // 2
