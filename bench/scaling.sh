#!/usr/bin/env bash
# Run time, messages and memory of the fluid alone and with cells on 1, 2 and 4 ranks: scaling.csv
# and scaling.png. Ranks that have no core of their own are marked as oversubscribed.
#   usage: scaling.sh --output FOLDER|--update [--repeats n]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
LMP_RBC=$BUILD/lmp_rbc MPIEXEC=$(command -v mpiexec) "$PYTHON" "$ROOT/bench/scaling.py" "$@"
