#!/usr/bin/env bash
# Flows along and around curved walls of markers: curved_walls.csv and curved_walls.png (two
# minutes).
#   usage: curved_walls.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 curved_walls
"$PYTHON" "$ROOT/bench/curved_walls.py" --program "$BUILD/curved_walls" "$@"
