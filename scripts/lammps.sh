#!/usr/bin/env bash
# Fetches the LAMMPS source from Debian and builds it once into the cache, keyed by version and
# options, unless this Debian has the library. Prints nothing but progress; leaves
# $CACHE/lammps-<version>/{source,build-<key>}.
#   usage: lammps.sh [4Feb2025|newest]
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/lammps_version.sh" "${1:-4Feb2025}"

# What is half done goes when the script ends, however it ends.
scratch='' partial=''
clean() {
  rm -rf "$scratch" "$partial"
  [ ! -d "$LAMMPS_HOME" ] || rmdir --ignore-fail-on-non-empty "$LAMMPS_HOME"
}

# Lists of the suite's sources, apart from those of this machine.
update_lists() {
  [ -z "$scratch" ] || return 0
  scratch=$(mktemp -d)
  mkdir -p "$scratch/lists/partial" "$scratch/cache/archives/partial"
  cat >"$scratch/source.list" <<LIST
deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $uri $LAMMPS_SUITE main
LIST
  cat >"$scratch/apt.conf" <<CONF
Dir::Etc::SourceList "$scratch/source.list";
Dir::Etc::SourceParts "-";
Dir::State::Lists "$scratch/lists";
Dir::Cache "$scratch/cache";
APT::Sandbox::User "root";
CONF
  export APT_CONFIG=$scratch/apt.conf
  apt-get update -q -o APT::Update::Error-Mode=any
}

# Whether Debian has another LAMMPS than the one here, which was the newest when it was fetched.
is_outdated() {
  local archive
  { update_lists && archive=$(apt-get source -q --tar-only --print-uris lammps |
    awk '$2 ~ /[.]orig[.]tar[.]/ {print $2}') && [ -n "$archive" ]; } || {
    say "the LAMMPS here is taken for the newest: $uri does not say (is there a network?)"
    return 1
  }
  [ "$archive" != "$(cat "$LAMMPS_HOME/archive" 2>/dev/null)" ]
}

# Files are as new as their unpacking: what was built with another version is older.
fetch_source() {
  local header archive
  [ -n "$uri" ] || fail "there is no Debian main archive in this machine's apt configuration"
  say "fetching the LAMMPS $LAMMPS_VERSION source from Debian"
  { update_lists && (cd "$scratch" && apt-get source -q --tar-only lammps); } ||
    fail "the LAMMPS $LAMMPS_VERSION source could not be fetched from $uri (see above):" \
      "is there a network?"
  partial=$LAMMPS_HOME/source.partial
  rm -rf "$partial"
  mkdir -p "$partial" || fail "$LAMMPS_HOME cannot be written: set USER_RBC_CACHE to another folder"
  archive=("$scratch"/lammps_*.orig.tar.*)
  tar -xmf "${archive[0]}" -C "$partial" --exclude=examples --exclude=bench
  # Some of these archives have a top folder, some have not.
  header=$(find "$partial" -maxdepth 3 -path '*/src/lammps.h')
  rm -rf "$LAMMPS_HOME"/{source,build-*}
  mv "${header%/src/lammps.h}" "$LAMMPS_HOME/source"
  echo "${archive[0]##*/}" >"$LAMMPS_HOME/archive"
}

[ "$LAMMPS_DEBIAN" = no ] || "$ROOT/scripts/dependencies.sh" liblammps-dev

if [ ! -d "$LAMMPS_HOME/source" ] || [ "$LAMMPS_VERSION" = newest ]; then
  trap clean EXIT
  trap 'exit 1' HUP INT TERM
  uri=$(debian_archive) || uri=''
  [ -d "$LAMMPS_HOME/source" ] && ! is_outdated || fetch_source
fi

if [ "$LAMMPS_DEBIAN" = no ] && [ ! -f "$LAMMPS_BUILD/installed" ]; then
  say "building LAMMPS $LAMMPS_VERSION once into $LAMMPS_BUILD"
  cmake -S "$LAMMPS_HOME/source/cmake" -B "$LAMMPS_BUILD" -G Ninja "${LAMMPS_OPTIONS[@]}" \
    -D CMAKE_PROJECT_lammps_INCLUDE="$ROOT/cmake/precompile_lammps.cmake"
  cmake --build "$LAMMPS_BUILD" -j "$JOBS"
  touch "$LAMMPS_BUILD/installed"
fi
