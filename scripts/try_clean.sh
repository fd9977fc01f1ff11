#!/usr/bin/env bash
# Runs both commands of README.md step by step in a new, minimal Debian of each suite, from an empty
# cache, with what is committed, and says how long each step took: by the clock and in time of a
# core. In sid it is the second one alone, with the newest LAMMPS. Arguments after -- go to ctest:
# -N lists the tests, and runs none. As root.
#   usage: try_clean.sh SUITE ... [-- ctest options]      such as bookworm, trixie or sid
. "$(dirname "$0")/common.sh"

suites=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  suites+=("$1")
  shift
done
[ ${#suites[@]} -gt 0 ] || fail "name a suite of Debian: bookworm, trixie or sid"
. "$ROOT/scripts/clean_debian.sh"

script() { inside bash "/root/user-rbc/scripts/$1" "${@:2}"; }

try_suite() {
  local version=4Feb2025
  [ "$1" != sid ] || version=newest
  new_debian "$1"
  mkdir "$debian/root/user-rbc"
  git -C "$ROOT" archive HEAD | tar -x -C "$debian/root/user-rbc"

  start_sum
  timed "packages of Debian" script dependencies.sh
  timed "LAMMPS $version" script lammps.sh "$version"
  timed "lmp_rbc and plugin" script build.sh "$version" lmp_rbc rbcplugin
  if [ "$version" = 4Feb2025 ]; then
    timed "a cell in shear" script shear_cell.sh
    say_sum "first command, $1"
    start_sum
  fi
  timed "tests are built" script build.sh "$version"
  timed "tests" script test.sh "$version" "${@:2}"
  say "$(grep -E 'tests passed|Total Tests' "$debian.log")"
  say_sum "second command, $1"
}

for suite in "${suites[@]}"; do
  try_suite "$suite" "${@:2}"
  remove_debian
done
