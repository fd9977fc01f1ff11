# Which LAMMPS, with which packages and options, where it is kept and where we build with it.
# Sourced after common.sh with the version's name.
case "$1" in
  4Feb2025) LAMMPS_VERSION=4Feb2025 LAMMPS_SUITE=trixie ;;
  newest) LAMMPS_VERSION=newest LAMMPS_SUITE=sid BUILD=$BUILD-newest ;;
  *) fail "LAMMPS version '$1' is not known; use 4Feb2025 or newest" ;;
esac

# Where this machine's Debian is of that suite its liblammps is the same version: yes.
# USER_RBC_OWN_LAMMPS=1 builds one nonetheless.
LAMMPS_DEBIAN=no
[ -n "${USER_RBC_OWN_LAMMPS:-}" ] || [ "$(debian_release)" != "$LAMMPS_SUITE" ] ||
  LAMMPS_DEBIAN=yes

# Packages are those that scenes and tests use.
LAMMPS_OPTIONS=(
  -D CMAKE_BUILD_TYPE=RelWithDebInfo -D CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2
  -D BUILD_SHARED_LIBS=yes -D BUILD_MPI=yes -D BUILD_OMP=no
  -D WITH_JPEG=no -D WITH_PNG=no -D WITH_GZIP=no -D WITH_FFMPEG=no -D WITH_CURL=no
)
for package in MOLECULE PLUGIN RIGID; do LAMMPS_OPTIONS+=(-D "PKG_$package=yes"); done

LAMMPS_HOME=$CACHE/lammps-$LAMMPS_VERSION
LAMMPS_BUILD=$LAMMPS_HOME/build-$(printf '%s\n' "${LAMMPS_OPTIONS[@]}" | md5sum | cut -c1-8)
