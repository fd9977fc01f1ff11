#!/usr/bin/env bash
# Slip of a wall of markers against solves: wall.csv and wall.png (a minute).
#   usage: wall.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 wall
"$PYTHON" "$ROOT/bench/wall.py" --program "$BUILD/wall" "$@"
