"""Elongation of cells as ektacytometry has it: of their shadows along the gradient of the flow."""
import numpy as np

from rbc.errors import InputError


def squared_extents(semi_axes, axes):
    """Of ellipsoids (..., 3) with unit vectors (..., 3, 3), a row each: the squares of how far they
    reach from their centres along x, y and z."""
    return np.einsum("...n,...nd->...d", np.square(semi_axes), np.square(axes))


def elongation_index(cells, flow="x", vorticity="y"):
    """(L - W)/(L + W) of cells, (steps, cells), of a table of compute rbc/cell.

    L is the length along the flow and W that along the vorticity, of the shadow that falls along
    the gradient of the flow. The shadow is that of the ellipsoid with the cell's moments. It is 0
    for a disc that faces the gradient and negative where a cell is wider than long.
    """
    if sorted((flow, vorticity)) not in (["x", "y"], ["x", "z"], ["y", "z"]):
        raise InputError(f"flow and vorticity must be two of x, y and z, not {flow} and "
                         f"{vorticity}")
    longest, short = (cells.vectors(*(f"{name}_{d}" for d in "xyz")) for name in ("long", "short"))
    axes = np.stack([longest, np.cross(short, longest), short], axis=-2)
    extents = np.sqrt(squared_extents(cells.vectors("long", "middle", "short"), axes))
    length, width = (extents[..., "xyz".index(one)] for one in (flow, vorticity))
    return (length - width) / (length + width)
