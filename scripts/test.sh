#!/usr/bin/env bash
# Builds and runs all tests; as many at once as there are processors for their ranks.
#   usage: test.sh [4Feb2025|newest [ctest options]]
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/lammps_version.sh" "${1:-4Feb2025}"

"$ROOT/scripts/build.sh" "$LAMMPS_VERSION"

say "testing $BUILD"
ctest --test-dir "$BUILD" --output-on-failure -j "$JOBS" "${@:2}"
