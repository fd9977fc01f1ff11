"""Distances between closed surfaces of triangles, by all pairs of triangles that may be near each
other."""

import itertools

import numpy as np


def _dot(a, b):
    return np.einsum("ij,ij->i", a, b)


def _points_to_triangles(p, a, b, c):
    """To the plane where the foot lies in the triangle; edges are left to _segments."""
    normal = np.cross(b - a, c - a)
    height = _dot(normal, p - a) / np.linalg.norm(normal, axis=1)
    inside = np.ones(len(p), bool)
    for u, v in ((a, b), (b, c), (c, a)):
        inside &= _dot(np.cross(v - u, p - u), normal) >= 0
    return np.where(inside, abs(height), np.inf)


def _segments(a, b, c, d):
    """Distance of the segments a-b and c-d: of the lines if both feet lie within, or else from an
    end."""
    u, v, w = b - a, d - c, a - c
    uu, vv, uv, uw, vw = _dot(u, u), _dot(v, v), _dot(u, v), _dot(u, w), _dot(v, w)
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = (uv * vw - vv * uw) / (uu * vv - uv**2), (uu * vw - uv * uw) / (uu * vv - uv**2)
    within = (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    apart = w + np.nan_to_num(s)[:, None] * u - np.nan_to_num(t)[:, None] * v
    lines = np.where(within, np.linalg.norm(apart, axis=1), np.inf)

    def end(p, q, direction, square):
        foot = np.clip(_dot(p - q, direction) / square, 0, 1)
        return np.linalg.norm(p - q - foot[:, None] * direction, axis=1)

    ends = end(a, c, v, vv), end(b, c, v, vv), end(c, a, u, uu), end(d, a, u, uu)
    return np.min([lines, *ends], axis=0)


def _cross(p, q, a, b, c):
    """Whether the segment p-q passes through the triangle: volumes of tetrahedra."""
    def volume(i, j, k, m):
        return _dot(np.cross(j - i, k - i), m - i)

    sides = [volume(p, q, u, v) > 0 for u, v in ((a, b), (b, c), (c, a))]
    through = (sides[0] == sides[1]) & (sides[1] == sides[2])
    return through & (volume(a, b, c, p) * volume(a, b, c, q) < 0)


def triangle_distances(first, second):
    """Of pairs of triangles, each an array (pairs, corner, coordinate); 0 where they cut each
    other."""
    least = np.full(len(first), np.inf)
    for one, other in ((first, second), (second, first)):
        corners = other.transpose(1, 0, 2)
        for i in range(3):
            p, q = one[:, i], one[:, (i + 1) % 3]
            least = np.minimum(least, _points_to_triangles(p, *corners))
            least[_cross(p, q, *corners)] = 0
    for i, j in itertools.product(range(3), repeat=2):
        least = np.minimum(least, _segments(first[:, i], first[:, (i + 1) % 3],
                                            second[:, j], second[:, (j + 1) % 3]))
    return least


def pair_distances(cells, box, periodic, reach):
    """Least distance of each two surfaces (lists of vertices and triangles), images too, that are
    nearer than `reach`; cells within cells are not noticed."""
    meshes = []
    for vertices, triangles in cells:
        corners = vertices[triangles]
        middles = corners.mean(axis=1)
        size = np.linalg.norm(corners - middles[:, None], axis=2).max(axis=1)
        centre = vertices.mean(axis=0)
        radius = np.linalg.norm(vertices - centre, axis=1).max()
        meshes.append((corners, middles, size, centre, radius))
    images = list(itertools.product(*[(-1, 0, 1) if wraps else (0,) for wraps in periodic]))
    centres, radii = np.array([mesh[3] for mesh in meshes]), np.array([mesh[4] for mesh in meshes])
    distances = []
    for n, (corners, middles, size, centre, radius) in enumerate(meshes):
        base = np.round((centres - centre) / box) * np.array(periodic)
        for image in images:
            shifts = (np.array(image) - base) * box
            near = np.linalg.norm(centres + shifts - centre, axis=1) < radii + radius + reach
            for other in np.flatnonzero(near):
                if other <= n:
                    continue
                others, their_middles, their_size = meshes[other][:3]
                shift = shifts[other]
                close = size.max() + their_size.max() + reach
                mine = _inside(middles, their_middles + shift, close)
                theirs = _inside(their_middles + shift, middles, close)
                apart = middles[mine][:, None] - (their_middles[theirs] + shift)[None]
                square = np.einsum("ijk,ijk->ij", apart, apart)
                i, j = np.nonzero(square < close**2)
                if len(i):
                    bound = np.sqrt(square[i, j]) - size[mine[i]] - their_size[theirs[j]]
                    least = _least(corners[mine[i]], others[theirs[j]] + shift, bound)
                    if least < reach:
                        distances.append(least)
    return np.array(distances)


def _least(first, second, bound, several=200):
    """Least distance of pairs of triangles; none is below its bound."""
    order = np.argsort(bound)
    least = triangle_distances(first[order[:several]], second[order[:several]]).min()
    rest = order[several:][bound[order[several:]] < least]
    return min(least, triangle_distances(first[rest], second[rest]).min(initial=least))


def _inside(points, others, margin):
    """Numbers of the points in the box around the others."""
    above, below = points > others.min(axis=0) - margin, points < others.max(axis=0) + margin
    return np.flatnonzero((above & below).all(axis=1))


def least_gap(cells, box, periodic, reach):
    """Between any two surfaces, up to `reach`."""
    return pair_distances(cells, box, periodic, reach).min(initial=reach)
