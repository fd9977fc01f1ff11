#!/usr/bin/env bash
# Tells whether another build of lmp_rbc computes the same as this one, to the last bits, in all
# scenes; or how many instructions both take.
#   usage: compare_builds.sh <other lmp_rbc> [--only word ...] [--ranks 1 2] [--steps 50]
#          compare_builds.sh <other lmp_rbc> --instructions [scene]
. "$(dirname "$0")/../scripts/common.sh"

other=$(realpath "${1:?path of the other lmp_rbc}")
shift
"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
export BUILD MPIEXEC=$(command -v mpiexec)
"$PYTHON" "$ROOT/bench/compare_builds.py" "$other" "$BUILD/lmp_rbc" "$@"
