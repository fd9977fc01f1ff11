"""Files cells.<step>.vtp that a run wrote, and pictures of them for a figure."""
import glob
import os
import re

from rbc.errors import InputError


def series(files):
    """(step, file) of files that are named by their steps, in order of the steps."""
    found = []
    for name in map(os.fspath, files):
        step = re.search(r"(\d+)\.\w+$", os.path.basename(name))
        if not step:
            raise InputError(f"{name} does not end in a step, as cells.100.vtp does")
        found.append((int(step[1]), name))
    return sorted(found)


def surfaces(folder):
    """(step, file), in order of the steps."""
    return series(glob.glob(os.path.join(folder, "cells.*.vtp")))


def picture(surface, box):
    """Image of a cell in the middle of a cubic box, seen along the vorticity."""
    from matplotlib.image import imread

    from rbc.rendering import Look, render

    png = surface[:-4] + ".png"
    render(surface, png, Look(box=[0, box] * 3, view=(10, 8), zoom=2.4, size=(480, 360)))
    return imread(png)
