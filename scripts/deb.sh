#!/usr/bin/env bash
# Installs what is missing and makes a Debian package for the release of this machine, with pages
# and for any processor of its kind, in <build folder>-deb.
#   usage: deb.sh [4Feb2025|newest]
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/lammps_version.sh" "${1:-4Feb2025}"
export USER_RBC_BUILD=$BUILD-deb

"$ROOT/scripts/dependencies.sh" file
"$ROOT/scripts/lammps.sh" "$LAMMPS_VERSION"

debian=$(. /etc/os-release && echo "${VERSION_ID:-sid}")
say "building USER-RBC with LAMMPS $LAMMPS_VERSION for any processor into $USER_RBC_BUILD"
cmake -S "$ROOT" -B "$USER_RBC_BUILD" -G Ninja -D LAMMPS_VERSION="$LAMMPS_VERSION" \
  -D RBC_NATIVE=OFF -D CPACK_DEBIAN_PACKAGE_RELEASE="deb$debian"
cmake --build "$USER_RBC_BUILD" -j "$JOBS" --target lmp_rbc rbcplugin
"$ROOT/scripts/html.sh"

rm -f "$USER_RBC_BUILD"/*.deb
(cd "$USER_RBC_BUILD" && cpack -G DEB -D CPACK_CMAKE_GENERATOR=Ninja)
say "apt-get install $(ls "$USER_RBC_BUILD"/*.deb)"
