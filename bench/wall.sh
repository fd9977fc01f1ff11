#!/usr/bin/env bash
# Slip of a wall of markers against solves: writes bench/wall.csv and bench/wall.png (a minute).
. "$(dirname "$0")/../scripts/common.sh"

"$ROOT/scripts/build.sh" 4Feb2025 wall
"$BUILD/wall" > "$ROOT/bench/wall.csv"
"$PYTHON" "$ROOT/bench/wall.py"
