"""Tumbling and tank-treading of one cell from a dump of its vertices (`dump custom ... id xu yu
zu`).

In the plane of shear (x, z) the shape turns with the long axis of the vertices' second moments, the
membrane with the rotation that best maps the vertices from one frame to the next. A tumbling cell
turns as one: both rates agree. A tank-treading cell keeps its shape's angle while the membrane runs
around it. Rates are given over the shear rate; a rigid sphere turns at -1/2.

The rotation that maps best is not how often the membrane goes around: on an ellipse of axes a and b
it is 2 a b / (a^2 + b^2) of that. The frequency that experiments count, the revolutions of the
vertices around the centre, is given beside it.

Means are over whole half turns of a shape that tumbles.
"""
import numpy as np

from rbc.errors import InputError
from rbc.text_files import as_numbers, read_head, refuse_others

COLUMNS = "id", "xu", "yu", "zu"


def read_dump(path):
    """Steps and unwrapped positions [frame, vertex, 3] of a text dump, sorted by atom ID."""
    refuse_others(path, read_head(path), "dump")
    steps, frames = [], []
    with open(path, encoding="utf-8", errors="replace") as stream:
        try:
            for line in stream:
                if line.startswith("ITEM: TIMESTEP"):
                    steps.append(int(next(stream)))
                elif line.startswith("ITEM: NUMBER OF ATOMS"):
                    count = int(next(stream))
                elif line.startswith("ITEM: ATOMS"):
                    frames.append(frame(path, line.split()[2:],
                                        [next(stream).split() for _ in range(count)]))
        except StopIteration:
            raise InputError(f"{path}: step {steps[-1] if steps else ''} is cut off") from None
    if not frames:
        raise InputError(f"{path} holds no step of a text dump of atoms")
    if len({len(one) for one in frames}) > 1:
        raise InputError(f"{path}: the number of atoms changes")
    return np.array(steps), np.array(frames)


def frame(path, columns, rows):
    """Positions [vertex, 3], sorted by atom ID."""
    missing = [name for name in COLUMNS if name not in columns]
    if missing:
        raise InputError(f"{path} has no column {missing[0]}; it has {' '.join(columns)}")
    table = as_numbers(path, rows)
    if table.shape != (len(rows), len(columns)):
        raise InputError(f"{path} has a step that is cut off")
    table = table[:, [columns.index(name) for name in COLUMNS]]
    return table[np.argsort(table[:, 0]), 1:]


def angles(positions):
    """Accumulated angle of the shape and of the membrane in the x-z plane, radians, [frame]."""
    plane = positions[:, :, [0, 2]] - positions[:, :, [0, 2]].mean(axis=1, keepdims=True)
    x, z = plane[..., 0], plane[..., 1]
    shape = 0.5 * np.arctan2(2 * (x * z).sum(1), (x * x - z * z).sum(1))
    shape = 0.5 * np.unwrap(2 * shape)
    turn = np.arctan2((x[:-1] * z[1:] - z[:-1] * x[1:]).sum(1),
                      (x[:-1] * x[1:] + z[:-1] * z[1:]).sum(1))
    return shape, np.concatenate([[0.0], np.cumsum(turn)])


def revolutions(positions, clearance=0.4):
    """How often each vertex has gone around the centre in the x-z plane since the first frame,
    [frame, vertex].

    Only vertices that stay further than `clearance` from the axis through the centre along y.
    """
    plane = positions[:, :, [0, 2]] - positions[:, :, [0, 2]].mean(axis=1, keepdims=True)
    plane = plane[:, np.linalg.norm(plane, axis=2).min(axis=0) > clearance]
    turns = np.unwrap(np.arctan2(plane[..., 1], plane[..., 0]), axis=0) / (2 * np.pi)
    return turns - turns[0]


def after_half_turns(time, shape):
    """When a shape has made as many half turns as it completes; the last time of all if it
    completes none."""
    turned = np.maximum.accumulate(abs(shape - shape[0]) / np.pi)
    whole = np.floor(turned[-1] + 1e-9)
    return time[-1] if whole == 0 else np.interp(whole, turned, time)


def mean_motion(strain, positions, start):
    """Means from a strain of `start` on: the strains they are over, and over the shear rate at what
    the shape turns, at what the membrane and how often each vertex goes around the centre; the
    least and the largest angle of the shape up to the end, degrees."""
    shape, membrane = angles(positions)
    late = strain >= min(start, strain[-1] / 2)
    strain, shape, membrane, positions = strain[late], shape[late], membrane[late], positions[late]
    end = after_half_turns(strain, shape)

    def rate(angle):
        return (np.interp(end, strain, angle) - angle[0]) / (end - strain[0])

    return {"from": strain[0], "to": end, "shape": rate(shape), "membrane": rate(membrane),
            "revolutions": np.array([rate(vertex) for vertex in revolutions(positions).T]),
            "least": np.degrees(shape.min()), "largest": np.degrees(shape.max())}
