#!/usr/bin/env bash
# Time of pair rbc/jkr for 512 red cells in contact, per evaluation and per search of near
# triangles, on one core: contact.csv.
#   usage: contact.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
LMP_RBC=$BUILD/lmp_rbc "$PYTHON" "$ROOT/bench/contact.py" "$@"
