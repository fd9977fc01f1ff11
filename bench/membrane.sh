#!/usr/bin/env bash
# Time of the membrane's forces on one core, alone and in runs of LAMMPS; prints a table and writes
# membrane.csv.
#   usage: membrane.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 membrane lmp_rbc
"$BUILD/membrane" --benchmark_format=json --benchmark_repetitions=5 > "$BUILD/membrane.json"
LMP_RBC=$BUILD/lmp_rbc "$PYTHON" "$ROOT/bench/membrane.py" "$BUILD/membrane.json" "$@"
