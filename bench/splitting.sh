#!/usr/bin/env bash
# Splitting error of the projection scheme: splitting.csv and splitting.png.
#   usage: splitting.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 splitting
"$PYTHON" "$ROOT/bench/splitting.py" --program "$BUILD/splitting" "$@"
