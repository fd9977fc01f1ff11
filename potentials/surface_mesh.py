"""Closed triangle meshes as arrays: vertices (n, 3) and triangles (m, 3), from 0, right-handed
outward."""
from collections import Counter

import numpy as np

DEGENERATE = 1e-7  # area over squared longest edge; single precision leaves about this


def hilbert_order(points, bits=16):
    """Order of the points along a Hilbert curve (Skilling, AIP Conf Proc 707, 381 (2004))."""
    low = points.min(axis=0)
    # The odd offset keeps mirror planes off the cell faces.
    scaled = (points - low) / (points - low).max() * 0.97 + 0.0123
    cell = (scaled * (1 << bits)).astype(np.int64).T
    for b in range(bits - 1, 0, -1):
        bit, below = 1 << b, (1 << b) - 1
        for i in range(3):
            swap = np.where(cell[i] & bit, 0, (cell[0] ^ cell[i]) & below)
            cell[0] ^= np.where(cell[i] & bit, below, swap)
            cell[i] ^= swap
    cell[1] ^= cell[0]
    cell[2] ^= cell[1]
    flip = np.zeros_like(cell[0])
    for b in range(bits - 1, 0, -1):
        flip ^= np.where(cell[2] & (1 << b), (1 << b) - 1, 0)
    cell ^= flip
    key = np.zeros_like(flip)
    for b in range(bits - 1, -1, -1):
        for i in range(3):
            key = key << 1 | (cell[i] >> b & 1)
    return np.argsort(key, kind="stable")


def renumber(order, triangles):
    """Vertex order[i] becomes vertex i; each triangle starts from its lowest vertex, the lowest
    triangle first."""
    rank = np.empty(len(order), dtype=int)
    rank[order] = np.arange(len(order))
    triangles = rank[triangles]
    first = triangles.argmin(axis=1)[:, None]
    triangles = np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1)
    return triangles[np.lexsort(triangles.T[::-1])]


def enclosed_volume(points, triangles):
    """Signed volume; positive when the triangles are right-handed outward."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def centre_of_volume(points, triangles):
    """Centroid of what the surface encloses."""
    origin = points.mean(axis=0)
    corner = points[triangles] - origin
    weight = np.linalg.det(corner)
    return origin + weight @ corner.sum(axis=1) / (4 * weight.sum())


def pieces(count, triangles):
    """Number of connected pieces of the surface."""
    label = np.arange(count)
    while True:
        lowest = label.copy()
        np.minimum.at(lowest, triangles, label[triangles].min(axis=1)[:, None])
        lowest = lowest[lowest]
        if (lowest == label).all():
            return len(np.unique(label))
        label = lowest


def fans(triangles):
    """Number of fans of triangles at each vertex: more than one where the surface touches
    itself."""
    count = np.zeros(triangles.max() + 1, dtype=int)
    following = {}
    for a, b, c in triangles.tolist():
        for v, w, x in ((a, b, c), (b, c, a), (c, a, b)):
            following.setdefault(v, {})[w] = x
    for v, ring in following.items():
        while ring:
            count[v] += 1
            w = next(iter(ring))
            while w in ring:
                w = ring.pop(w)
    return count


def check(points, triangles):
    """Raise ValueError, saying why, unless the mesh is one closed, outward oriented sphere."""
    def at(vertex):
        return "({:.6g}, {:.6g}, {:.6g})".format(*points[vertex])

    edges = Counter(
        map(tuple, np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]).tolist()))
    both = {edge: n + edges.get(edge[::-1], 0) for edge, n in edges.items()}
    for problem, broken in (
            ("is not manifold: {} edges belong to more than two triangles",
             [e for e, n in both.items() if n > 2]),
            ("is not closed: {} edges belong to one triangle only",
             [e for e, n in both.items() if n < 2]),
            ("is not consistently oriented: {} edges are run through twice in the same direction",
             [e for e, n in edges.items() if n > 1])):
        if broken:
            number = len({tuple(sorted(edge)) for edge in broken})
            raise ValueError(f"the surface {problem.format(number)}, one of them from "
                             f"{at(broken[0][0])} to {at(broken[0][1])}")
    unused = np.setdiff1d(np.arange(len(points)), triangles)
    if len(unused):
        raise ValueError(
            f"{len(unused)} vertices belong to no triangle, one of them at {at(unused[0])}")
    found = pieces(len(points), triangles)
    if found > 1:
        raise ValueError(f"the surface is in {found} pieces; a cell is one")
    touching = np.flatnonzero(fans(triangles) > 1)
    if len(touching):
        raise ValueError(f"the surface touches itself at {len(touching)} vertices, one of them "
                         f"{at(touching[0])}")
    euler = len(points) - len(edges) // 2 + len(triangles)
    if euler != 2:
        raise ValueError(
            f"the surface has {(2 - euler) // 2} handles (Euler characteristic {euler}, not 2); "
            "a cell is a sphere topologically")
    edge = np.roll(points[triangles], -1, axis=1) - points[triangles]
    area = np.linalg.norm(np.cross(edge[:, 0], edge[:, 1]), axis=1) / 2
    flat = np.flatnonzero(area <= DEGENERATE * (edge ** 2).sum(axis=2).max(axis=1))
    if len(flat):
        raise ValueError(
            f"{len(flat)} triangles have no area, one of them at {at(triangles[flat[0], 0])}")
    if enclosed_volume(points, triangles) <= 0:
        raise ValueError("the triangles point inward")


def measure(points, triangles):
    """Area, volume, edge lengths, angles (degrees) and area ratio of a mesh."""
    corner = points[triangles]
    edge = np.roll(corner, -1, axis=1) - corner
    length = np.linalg.norm(edge, axis=2)
    cosine = -(edge * np.roll(edge, 1, axis=1)).sum(axis=2) / (length * np.roll(length, 1, axis=1))
    angle = np.degrees(np.arccos(cosine))
    area = np.linalg.norm(np.cross(edge[:, 0], edge[:, 1]), axis=1) / 2
    return {"area": area.sum(), "volume": enclosed_volume(points, triangles),
            "edge": (length.min(), length.mean(), length.max()),
            "angle": (angle.min(), angle.max()), "area_ratio": area.max() / area.min()}
