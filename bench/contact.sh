#!/usr/bin/env bash
# Time of pair rbc/jkr for 512 red cells in contact, per evaluation and per search of near triangles, on one core.
# Writes contact.csv.
. "$(dirname "$0")/../scripts/common.sh"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
mkdir -p "$BUILD/contact"
cd "$BUILD/contact"
LMP_RBC=$BUILD/lmp_rbc "$PYTHON" "$ROOT/bench/contact.py"
