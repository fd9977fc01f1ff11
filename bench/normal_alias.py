#!/usr/bin/python3
"""Velocity that the grid gives a closed surface under an even pressure, which should be none.

A plane that bears an even force along its normal n has forces of all wave vectors k n. The grid
takes those beyond its reach for waves of other directions, k n + 2 pi m, which flow does not
balance by pressure. Their flow is what kernels see of it: velocity over force per area, spacing
over viscosity, in the mean over all places of the plane. Prints it for some directions, and the
factor of fluid/normal_alias.cpp, a fit for all directions.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "scripts"))
from rbc import command_line  # noqa: E402
import numpy as np  # noqa: E402

FARTHEST, STEP = 30, 0.01    # wave numbers, their steps
DIRECTIONS = 400
SOME = ((0, 0, 1), (0, 1, 2), (0, 1, 1), (1, 1, 2), (1, 1, 1), (1, 2, 3))


def peskin4(r):
    r = np.abs(r)
    near = (3 - 2 * r + np.sqrt(np.maximum(1 + 4 * r - 4 * r**2, 0))) / 8
    far = (5 - 2 * r - np.sqrt(np.maximum(-7 + 12 * r - 4 * r**2, 0))) / 8
    return np.where(r < 1, near, np.where(r < 2, far, 0))


def roma3(r):
    r = np.abs(r)
    near = (1 + np.sqrt(np.maximum(1 - 3 * r**2, 0))) / 3
    far = (5 - 3 * r - np.sqrt(np.maximum(1 - 3 * (1 - r)**2, 0))) / 6
    return np.where(r < 0.5, near, np.where(r < 1.5, far, 0))


KERNELS = {"peskin4": (peskin4, 0.524, 0.655), "roma3": (roma3, 0.30, 0.2065)}    # as sheets


def transform(kernel):
    """Of a kernel, at any wave numbers."""
    r = np.linspace(-2, 2, 8001)
    at = np.linspace(0, FARTHEST, 3001)
    values = np.cos(np.outer(at, r)) @ kernel(r) * (r[1] - r[0])
    return lambda k: np.interp(np.abs(k), at, values)


def alias(normal, kernel, second, fourth):
    """On a staggered grid: component c lies half a cell further along c."""
    k = np.arange(-FARTHEST + STEP / 2, FARTHEST, STEP)[:, None] * normal
    seen = np.prod(kernel(k), axis=1)**2
    turns = np.round(k / (2 * np.pi))
    wave = 2 * np.sin((k - 2 * np.pi * turns) / 2)
    square = np.maximum((wave**2).sum(axis=1), 1e-12)
    force = normal * (-1)**turns
    flow = (force - wave * ((wave * force).sum(axis=1) / square)[:, None]) / square[:, None]
    sharpened = 1 + second * square + fourth * square**2
    return (seen * sharpened * (flow * force).sum(axis=1)).sum() * STEP / (2 * np.pi)


def shape(normals):
    """The least polynomial with the symmetry of a cube that is zero where all components of a
    normal that are not zero are alike: there waves stay along it."""
    return (normals**6).sum(axis=1) - (normals**4).sum(axis=1)**2


def main():
    command_line.parser(__doc__).parse_args()
    normals = np.random.default_rng(1).normal(size=(DIRECTIONS, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    print(f"{'':14s}" + "".join(f"{str(some):>12s}" for some in SOME))
    for name, (kernel, *correction) in KERNELS.items():
        seen = transform(kernel)
        for kind, sharpening in (("points", (0, 0)), ("sheets", correction)):
            some = [alias(np.array(n) / np.linalg.norm(n), seen, *sharpening) for n in SOME]
            print(f"{name} {kind}" + "".join(f"{value:12.3e}" for value in some))
            values = np.array([alias(n, seen, *sharpening) for n in normals])
            shapes = shape(normals)
            factor = (shapes @ values) / (shapes @ shapes)
            rms = np.sqrt(((factor * shapes - values)**2).mean())
            print(f"  mean {values.mean():.3e}, factor {factor:.3e}, rms error "
                  f"{rms / values.mean():.1%} of the mean")


if __name__ == "__main__":
    main()
