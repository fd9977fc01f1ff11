#!/usr/bin/env bash
# Dense blood for two hours on 2 ranks, in pieces of 200 steps and in four processes, each of which
# continues from a restart file of the one before it: memory, volumes, steps taken again: soak.csv.
#   usage: soak.sh --output FOLDER|--update [--seconds n] [--processes n] [--ranks n]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
LMP_RBC=$BUILD/lmp_rbc MPIEXEC=$(command -v mpiexec) "$PYTHON" "$ROOT/bench/soak.py" "$@"
