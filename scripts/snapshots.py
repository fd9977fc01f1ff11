"""Surfaces cells.<step>.vtp that a run wrote, and pictures of them for a figure."""
import glob
import os
import re
import subprocess

import matplotlib.pyplot as plt

SCRIPTS = os.path.dirname(os.path.abspath(__file__))


def surfaces(folder):
    """(step, file), in order of the steps."""
    files = glob.glob(os.path.join(folder, "cells.*.vtp"))
    return sorted((int(re.search(r"cells\.(\d+)\.", name).group(1)), name) for name in files)


def picture(surface, box):
    """Image of a cell in the middle of a cubic box, seen along the vorticity."""
    png = surface[:-4] + ".png"
    subprocess.run([os.path.join(SCRIPTS, "render_cells.py"), surface, "-o", png, "--box", *(["0", str(box)] * 3),
                    "--view", "10", "8", "--zoom", "2.4", "--size", "480x360"], check=True)
    return plt.imread(png)
