#!/usr/bin/env bash
# Installs what is missing, builds LAMMPS once per machine, then this package into build/
# (build-newest/). Quick when nothing changed.
#   usage: build.sh [4Feb2025|newest [target ...]]
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/lammps_version.sh" "${1:-4Feb2025}"

"$ROOT/scripts/dependencies.sh"
"$ROOT/scripts/lammps.sh" "$LAMMPS_VERSION"

say "building USER-RBC with LAMMPS $LAMMPS_VERSION into $BUILD"
[ -f "$BUILD/build.ninja" ] ||
  cmake -S "$ROOT" -B "$BUILD" -G Ninja -D LAMMPS_VERSION="$LAMMPS_VERSION"
targets=("${@:2}")
cmake --build "$BUILD" -j "$JOBS" --target "${targets[@]:-all}"
