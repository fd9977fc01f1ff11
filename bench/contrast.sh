#!/usr/bin/env bash
# What an inside of another viscosity costs in dense blood: solves, iterations and time of a step;
# contrast.csv.
#   usage: contrast.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
"$PYTHON" "$ROOT/bench/contrast.py" --lmp "$BUILD/lmp_rbc" "$@"
