"""Shapes of cells as maps of the geodesic unit sphere, which fixes their triangles."""
import math

import numpy as np

PROFILE = 0.207, 2.002, -1.122


def icosahedron():
    """Unit vertices (12, 3) and outward faces (20, 3); three of its two-fold axes are x, y, z."""
    golden = (1 + math.sqrt(5)) / 2
    corner = np.array([(0, s, t * golden) for s in (1, -1) for t in (1, -1)])
    points = np.concatenate([np.roll(corner, k, axis=1) for k in range(3)])
    close = ((points[:, None] - points) ** 2).sum(axis=2) < 5
    faces = [(i, j, k) for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12)
             if close[i, j] and close[j, k] and close[k, i]]
    outward = [np.linalg.det(points[list(face)]) > 0 for face in faces]
    faces = [face if out else face[::-1] for face, out in zip(faces, outward)]
    return points / math.sqrt(1 + golden * golden), faces


def geodesic(frequency):
    """Unit sphere: vertices (10 f^2 + 2, 3) and outward triangles (20 f^2, 3).

    A point with barycentric counts i + j + k = f of face (a, b, c) is the direction of
    sin(i w/f) a + sin(j w/f) b + sin(k w/f) c, with w the angle of an icosahedral edge: equal
    steps along the edges, and triangle areas within a factor 1.2 of each other.
    """
    corners, faces = icosahedron()
    edge_angle = math.atan(2)
    # Rounded, so that every machine's sine gives the same file; the projection makes it exact.
    weight = [round(math.sin(edge_angle * i / frequency), 12) for i in range(frequency + 1)]
    index, points, triangles = {}, [], []

    def vertex(face, counts):
        key = tuple(sorted((corner, n) for corner, n in zip(face, counts) if n))
        if key not in index:
            index[key] = len(points)
            points.append(sum(weight[n] * corners[corner] for corner, n in key))
        return index[key]

    for face in faces:
        row = [[vertex(face, (frequency - i, i - j, j)) for j in range(i + 1)]
               for i in range(frequency + 1)]
        for i in range(frequency):
            triangles += [(row[i][j], row[i + 1][j], row[i + 1][j + 1]) for j in range(i + 1)]
            triangles += [(row[i][j], row[i + 1][j + 1], row[i][j + 1]) for j in range(i)]
    points = np.array(points)
    return points / np.sqrt((points ** 2).sum(axis=1))[:, None], np.array(triangles)


def disc_height(x):
    """Half thickness over R of the biconcave disc at x = r/R."""
    a0, a1, a2 = PROFILE
    square = x * x
    return 0.5 * np.sqrt((1 - x) * (1 + x)) * (a0 + square * (a1 + square * a2))


def spheroid_height(axis_ratio):
    """The same of a spheroid, by its axis along z over its diameter."""
    return lambda x: axis_ratio * np.sqrt((1 - x) * (1 + x))


class Profile:
    """Half a surface of revolution of R = 1 from pole to rim, z = height(r), by the angle phi:
    r = sin(phi)."""

    def __init__(self, height):
        self.height = height
        self.phi = np.linspace(0, np.pi / 2, 20001)
        r = np.sin(self.phi)
        arc = np.sqrt((np.diff(np.stack([r, height(r)])) ** 2).sum(axis=0))
        self.arc = np.append(0, np.cumsum(arc))
        cap = np.append(0, np.cumsum(arc * (r[1:] + r[:-1])))
        self.cap = cap / cap[-1]  # share of the area up to phi

    def at_arc(self, share):
        return np.interp(share * self.arc[-1], self.arc, self.phi)

    def with_caps_of(self, other, phi):
        """Angle here that cuts off the same share of the area as phi does on the other profile."""
        return np.interp(np.interp(phi, other.phi, other.cap), self.cap, self.phi)


def revolved(points, height, caps=None):
    """Map the unit sphere to a surface of revolution of R = 1.

    Latitude becomes arc length along the profile, in proportion: of the maps tried (equal area,
    conformal, same r), the one with the most even edges of the disc (table in README.md). With
    `caps`, the height of another such surface, each latitude cuts off the same share of the area as
    there.
    """
    profile = Profile(height)
    rho = np.sqrt((points[:, :2] ** 2).sum(axis=1))
    polar = np.arctan2(rho, np.abs(points[:, 2])) * (2 / np.pi)
    if caps:
        other = Profile(caps)
        phi = profile.with_caps_of(other, other.at_arc(polar))
    else:
        phi = profile.at_arc(polar)
    # Rounded as above: where on the profile a vertex sits may vary, that it sits on it may not.
    x = np.round(np.sin(phi), 9)
    direction = points[:, :2] / np.where(rho > 0, rho, 1)[:, None]
    return np.column_stack([x[:, None] * direction, np.copysign(height(x), points[:, 2])])


def disc(points):
    return revolved(points, disc_height)


def disc_size(radius):
    """Area and volume of the smooth disc."""
    a0, a1, a2 = PROFILE
    node, weight = np.polynomial.legendre.leggauss(200)
    phi, weight = np.pi / 4 * (node + 1), np.pi / 4 * weight
    r, cosine = np.sin(phi), np.cos(phi)
    shape_factor = 0.5 * (a0 + a1 * r ** 2 + a2 * r ** 4)
    slope = -r * shape_factor + cosine ** 2 * (a1 * r + 2 * a2 * r ** 3)
    area = 4 * np.pi * (weight * r * np.hypot(cosine, slope)).sum()
    volume = 4 * np.pi * (weight * r * cosine ** 2 * shape_factor).sum()
    return area * radius ** 2, volume * radius ** 3


def spheroid_size(axis_ratio, radius=1.0):
    """Area and volume of the smooth spheroid; a sphere for axis ratio 1."""
    q = axis_ratio
    if q == 1:
        side = 1
    elif q < 1:
        e = math.sqrt(1 - q * q)
        side = q * q * math.atanh(e) / e
    else:
        e = math.sqrt(1 - 1 / (q * q))
        side = q * math.asin(e) / e
    return 2 * math.pi * (1 + side) * radius ** 2, 4 / 3 * math.pi * q * radius ** 3


def reduced_volume(area, volume):
    """Volume over that of the sphere of the same area."""
    return 6 * math.sqrt(math.pi) * volume / area ** 1.5


def axis_ratio_of(reduced, prolate=False):
    """Axis ratio of the spheroid of a reduced volume."""
    if reduced == 1:
        return 1.0
    flat, round_ = 1e-6, 1.0
    for _ in range(60):
        middle = math.sqrt(flat * round_)
        of_middle = reduced_volume(*spheroid_size(1 / middle if prolate else middle))
        flat, round_ = (middle, round_) if of_middle < reduced else (flat, middle)
    ratio = round(round_, 12)
    return round(1 / ratio, 12) if prolate else ratio


def sickle(points, length, width, thickness, bend):
    """An ellipsoid whose long axis is bent to a circular arc of angle `bend`, in the x-y plane.

    The point (s, y, z) of the ellipsoid goes to ((R - y) sin(s/R), R - (R - y) cos(s/R), z) with
    R = length / bend, which keeps the volume: a stretch of (R - y)/R along the arc averages to 1
    over each section.
    """
    y, z, s = (revolved(points, spheroid_height(length / width)) * (width / 2)).T
    radius = length / bend
    angle, distance = s / radius, radius - y
    return np.column_stack([distance * np.sin(angle), radius - distance * np.cos(angle),
                            z * (thickness / width)])
