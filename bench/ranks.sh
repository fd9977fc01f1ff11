#!/usr/bin/env bash
# How far apart vertices of cells are on 2 and 4 ranks from where they are on 1, over the first
# steps of the scenes with vessels: ranks.csv and ranks.png.
#   usage: ranks.sh --output FOLDER|--update [--only scene ...]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
LMP_RBC=$BUILD/lmp_rbc MPIEXEC=$(command -v mpiexec) "$PYTHON" "$ROOT/bench/ranks.py" "$@"
