#!/usr/bin/env bash
# Errors of both forms of bending over the spacing of the mesh; writes bending.csv and bending.png.
. "$(dirname "$0")/../scripts/common.sh"

"$ROOT/scripts/build.sh" 4Feb2025 bending
"$BUILD/bending" > "$ROOT/bench/bending.csv"
"$PYTHON" "$ROOT/bench/bending.py"
