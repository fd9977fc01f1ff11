"""Resistance of a sphere near a plate, or near another one that moves as its mirror image does or
against that: to more digits than a grid gives, at gaps down to a hundredth of the radius.

Lamb's solution outside the sphere (Happel & Brenner, Low Reynolds number hydrodynamics, 1965,
section 3-2) is completed by its image in the plane at the plate, after Lorentz, or in the plane
between the spheres. Its coefficients are those with which the velocity is that of the sphere, in
the least squares of many points of its surface.
"""
import numpy as np

MOTIONS = "apart", "past", "turning across", "turning along"


def harmonics(x, order, count):
    """Decaying harmonics of degrees 1 to count: P_n, or P_n' times x/r (order "x") or y/r
    (order "y") over n, all times r^-(n+1)."""
    r = np.sqrt(x[0]**2 + x[1]**2 + x[2]**2)
    c = x[2] / r
    legendre, slope = [np.ones_like(c), c], [np.zeros_like(c), np.ones_like(c)]
    for n in range(2, count + 1):
        legendre.append(((2 * n - 1) * c * legendre[-1] - (n - 1) * legendre[-2]) / n)
        slope.append(slope[-2] + (2 * n - 1) * legendre[n - 1])
    n = np.arange(1, count + 1)[:, None]
    if order == "0":
        values = np.array(legendre[1:])
    else:
        values = np.array(slope[1:]) * x["xy".index(order)] / r / n
    return values * r**(-n - 1.0)


def gradient(function, x):
    """By complex steps, to the last digit."""
    slopes, step = [], 1e-30
    for d in range(3):
        moved = x.astype(complex)
        moved[d] += 1j * step
        slopes.append(function(moved).imag / step)
    return np.array(slopes)


def lamb(x, motion, count):
    """Velocities (coordinate, solution, point) and pressures of the solutions outside a unit sphere
    at the origin, those of the pressure first and those of the vorticity last."""
    n = np.arange(1, count + 1)[:, None]
    orders = {"apart": ("0", None), "turning along": (None, "0")}.get(motion, ("x", "y"))
    velocities, pressures = [], []
    if orders[0]:
        pressure = harmonics(x, orders[0], count)
        slope = gradient(lambda y: harmonics(y, orders[0], count), x)
        velocities.append((n + 1) / (n * (2 * n - 1)) * x[:, None, :] * pressure
                          - (n - 2) / (2 * n * (2 * n - 1)) * (x**2).sum(axis=0) * slope)
        velocities.append(slope / n)
        pressures += [pressure, np.zeros_like(pressure)]
    if orders[1]:
        slope = gradient(lambda y: harmonics(y, orders[1], count), x)
        velocities.append(np.cross(slope, np.broadcast_to(x[:, None, :], slope.shape), axis=0) / n)
        pressures.append(np.zeros_like(slope[0]))
    return np.concatenate(velocities, axis=1), np.concatenate(pressures)


MIRROR = np.array([1, 1, -1.0])[:, None, None]


def image_in_plate(image, height, motion, count):
    """What must be added so that the plate is at rest, at the points whose mirror images are given;
    height: of the points. After Lorentz: -v + 2 (w e_z - z grad w) + z^2 grad p, of mirrored
    fields."""
    def differences(part):
        step, slopes = 1e-5, []
        for d in range(3):
            above, below = image.copy(), image.copy()
            above[d] += step
            below[d] -= step
            slopes.append((part(lamb(above, motion, count)) - part(lamb(below, motion, count)))
                          / (2 * step))
        return MIRROR * np.array(slopes)

    mirrored = MIRROR * lamb(image, motion, count)[0]
    added = (2 * height * differences(lambda fields: fields[0][2])
             + height**2 * differences(lambda fields: fields[1]) - mirrored)
    added[2] += 2 * mirrored[2]
    return added


def surface(motion, count):
    """Points of a unit sphere, most of them near its lowest, and its velocity there."""
    places = 3 * count
    angle = np.concatenate([np.pi * (np.arange(places) + 0.5) / places,
                            np.pi - np.pi / 2 * (np.arange(1, places) / places)**2])
    turn = 0.7    # where all components of the velocity count
    x = np.array([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)])
    none, all_ = np.zeros_like(angle), np.ones_like(angle)
    velocity = {"apart": (none, none, all_), "past": (all_, none, none),
                "turning across": (x[2], none, -x[0]), "turning along": (-x[1], x[0], none)}[motion]
    return x, np.array(velocity)


def resistance(motion, gap, plate):
    """Force over 6 pi viscosity a U, or torque over 8 pi viscosity a^3 times the angular velocity;
    gap: over the radius, between the spheres or to the plate."""
    centre = 1 + (gap if plate else gap / 2)
    count = int(min(220, 12 + 9 / np.sqrt(centre - 1)))
    x, wanted = surface(motion, count)
    image = np.array([x[0], x[1], -x[2] - 2 * centre])
    velocities = lamb(x, motion, count)[0]
    if plate:
        velocities += image_in_plate(image, x[2] + centre, motion, count)
    else:
        sense = 1 if motion == "apart" else -1
        velocities += sense * MIRROR * lamb(image, motion, count)[0]
    equations = velocities.transpose(0, 2, 1).reshape(-1, velocities.shape[1])
    size = np.linalg.norm(equations, axis=0)
    found = np.linalg.lstsq(equations / size, wanted.ravel(), rcond=1e-13)[0]
    missed = abs(equations / size @ found - wanted.ravel()).max()
    if missed > 1e-3:
        raise ValueError(f"{motion}, gap {gap}: the sphere's velocity is missed by {missed:.2g}")
    found /= size
    if motion == "turning across":
        return found[2 * count]
    return found[0] if motion == "turning along" else found[0] / 1.5
