"""Measures of closed surfaces of triangles: those of compute rbc/cell, and what follows."""
from typing import NamedTuple

import numpy as np

from rbc.surfaces import Surfaces, read_surfaces


class Shape(NamedTuple):
    """Of the volume inside a surface, as if filled with a uniform material."""
    centre: np.ndarray
    area: float
    volume: float
    semi_axes: np.ndarray    # of the ellipsoid with the same moments, the longest first
    axes: np.ndarray         # unit vectors in their order, a row each

    @property
    def deformation(self):
        """Of Taylor, (L - B)/(L + B) with the longest and the shortest semi-axis."""
        return (self.semi_axes[0] - self.semi_axes[2]) / (self.semi_axes[0] + self.semi_axes[2])

    @property
    def inclination(self):
        """Angle of the long axis to a flow along x with its gradient along z, in degrees. For what
        is long, such as a capsule that is drawn out; for discs see tilt."""
        return float(angle_to_flow(self.axes[0]))

    @property
    def tilt(self):
        """Angle of the plane across the short axis to such a flow, in degrees: how a disc lies. Its
        long axis wanders within the disc."""
        x, _, z = self.axes[2]
        return float(angle_to_flow(np.array([z, 0, -x])))

    @property
    def reduced_volume(self):
        """Over that of the sphere with the same area: 1 for a sphere, less for all else."""
        return self.volume / (4 / 3 * np.pi * (self.area / (4 * np.pi)) ** 1.5)


def angle_to_flow(axis):
    """Angle in degrees in (-90, 90] to x of axes (..., 3) projected on the x-z plane."""
    angle = np.degrees(np.arctan2(axis[..., 2], axis[..., 0]))
    return 90 - (90 - angle) % 180


def shape_of(vertices, triangles):
    """Shape of a closed surface; exact for the polyhedron."""
    origin = vertices.mean(axis=0)
    corners = (vertices - origin)[triangles]
    a, b, c = corners.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    sixfold = np.einsum("ij,ij->i", a, np.cross(b, c))    # volumes of tetrahedra from the origin
    volume = sixfold.sum() / 6
    total = corners.sum(axis=1)
    centre = sixfold @ total / (24 * volume)
    second = (np.einsum("i,ikm,ikn->mn", sixfold, corners, corners)
              + np.einsum("i,im,in->mn", sixfold, total, total)) / 120
    moments, axes = np.linalg.eigh(second / volume - np.outer(centre, centre))
    axes = axes.T[::-1]
    first = [axis[np.flatnonzero(np.abs(axis) > 1e-12)[0]] for axis in axes]
    return Shape(origin + centre, np.linalg.norm(normal, axis=1).sum() / 2, volume,
                 np.sqrt(5 * moments[::-1]), axes * np.sign(first)[:, None])


def shapes_of(surfaces):
    """{molecule ID: Shape} of the cells of Surfaces, or of a .vtp or .pvtp file, given by its
    path."""
    if not isinstance(surfaces, Surfaces):
        surfaces = read_surfaces(surfaces)
    return {molecule: shape_of(*mesh) for molecule, mesh in surfaces.cells().items()}
