"""What USER-RBC writes, in numpy: tables of cells, surfaces, grids of the flow, logs; measures of
cells, and pictures.

`python3 -m rbc` lists its commands, and `help(rbc)` leads to the modules. A module is loaded when
one of its functions is first used, so that VTK and matplotlib are needed by what draws only.
"""
import importlib

HOMES = {
    "tables": ("History", "read_ave_time", "read_csv", "read_table"),
    "cell_tables": ("CELL_COLUMNS", "Cells", "cells_of_array", "read_cell_table"),
    "thermo_log": ("read_log",),
    "surfaces": ("Surfaces", "read_cells", "read_surfaces", "write_cells"),
    "snapshots": ("series",),
    "grids": ("Grid", "read_grid", "read_grids"),
    "means": ("mean_with_error",),
    "elongation": ("elongation_index",),
    "shapes": ("Shape", "angle_to_flow", "shape_of", "shapes_of"),
    "surface_distances": ("pair_distances",),
    "rendering": ("Look", "render"),
    "movies": ("write_movie",),
    "shear_plot": ("ShearLabels", "plot_shear"),
    "aggregates": ("mean_classes", "mean_median", "plot_aggregates", "plot_sizes",
                   "sizes_over_time"),
    "cell_statistics": ("Box", "pair_statistics", "plot_statistics", "rouleau_order"),
    "membrane_motion": ("mean_motion", "read_dump"),
    "driving": ("cells_now", "start_lammps"),
    "errors": ("InputError",),
}
_HOME = {name: home for home, names in HOMES.items() for name in names}
__all__ = sorted(_HOME)


def __getattr__(name):
    if name not in _HOME:
        raise AttributeError(f"module rbc has no {name}")
    return getattr(importlib.import_module(f"rbc.{_HOME[name]}"), name)


def __dir__():
    return sorted({*globals(), *__all__})
