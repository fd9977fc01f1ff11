#!/usr/bin/env bash
# Splitting error of the projection scheme; writes splitting.csv and splitting.png.
#   usage: splitting.sh
. "$(dirname "$0")/../scripts/common.sh"

"$ROOT/scripts/build.sh" 4Feb2025 splitting

"$BUILD/splitting" | tee "$ROOT/bench/splitting.csv"
"$PYTHON" "$ROOT/bench/splitting.py" "$ROOT/bench/splitting.csv" "$ROOT/bench/splitting.png"
