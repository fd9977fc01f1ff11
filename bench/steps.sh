#!/usr/bin/env bash
# How long the steps of dense blood may be: solves per strain, and errors of viscosity and
# positions; steps.csv.
#   usage: steps.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
"$PYTHON" "$ROOT/bench/steps.py" --lmp "$BUILD/lmp_rbc" "$@"
