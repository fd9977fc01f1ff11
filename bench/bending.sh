#!/usr/bin/env bash
# Errors of both forms of bending over the spacing of the mesh: bending.csv and bending.png.
#   usage: bending.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 bending
"$PYTHON" "$ROOT/bench/bending.py" --program "$BUILD/bending" "$@"
