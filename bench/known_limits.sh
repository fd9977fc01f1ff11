#!/usr/bin/env bash
# Orders, limits and errors that scripts/converge.py finds in examples of which they are known:
# known_limits.csv.
#   usage: known_limits.sh --output FOLDER|--update [--only case ...]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
"$PYTHON" "$ROOT/bench/known_limits.py" --lmp "$BUILD/lmp_rbc" "$@"
