#!/usr/bin/env bash
# How densely and how fast rbc/create packs red cells: run time on 1, 2 and 4 ranks, least gap,
# directions; packing.csv, packing.png and packing-cells.png.
#   usage: packing.sh --output FOLDER|--update [--quick]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
LMP_RBC=$BUILD/lmp_rbc MPIEXEC=$(command -v mpiexec) "$PYTHON" "$ROOT/bench/packing.py" "$@"
