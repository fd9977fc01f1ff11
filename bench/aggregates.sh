#!/usr/bin/env bash
# What compute rbc/aggregate takes per call, and that it takes nothing while it is not called:
# aggregates.csv.
#   usage: aggregates.sh --output FOLDER|--update [--cells 512 4096 49152] [--ranks 1 2]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
LMP_RBC=$BUILD/lmp_rbc MPIEXEC=$(command -v mpiexec) "$PYTHON" "$ROOT/bench/aggregates.py" "$@"
