# Shared by the scripts of this folder: where things are kept and how they are built.
set -euo pipefail

say() { printf '== %s\n' "$*"; }

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
CACHE=${USER_RBC_CACHE:-${XDG_CACHE_HOME:-${HOME:+$HOME/.cache}}}
[ -n "$CACHE" ] ||
  fail "HOME is not set: set USER_RBC_CACHE to a folder for LAMMPS and the compiler's cache"
[ -n "${USER_RBC_CACHE:-}" ] || CACHE=$CACHE/user-rbc
BUILD=${USER_RBC_BUILD:-$ROOT/build}
JOBS=${USER_RBC_JOBS:-$(nproc)}
# Debian's own interpreter, as the modules come as Debian packages: the PATH may have another one.
PYTHON=/usr/bin/python3
# What is not in the compiler's cache goes to the compiler, not to its preprocessor before.
export CCACHE_DIR=$CACHE/ccache CCACHE_DEPEND=1

# Open MPI refuses root and too many ranks by default; containers and small test machines need both.
# PRTE starts the ranks of Open MPI 5.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
export OMPI_MCA_hwloc_base_binding_policy=none
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
export PRTE_MCA_hwloc_default_binding_policy=none
export OMP_NUM_THREADS=1
# MPI looks for graphics cards by way of X server :0 and ends with it; that may be one for pictures.
export HWLOC_COMPONENTS=-gl

# The release of Debian that this machine has: bookworm, trixie, sid. The files of sid name the
# release to come, as that one's own do: apt knows which of them it is.
debian_release() {
  if grep -qs sid /etc/debian_version && [ -n "$(archive_of sid)" ]; then
    echo sid
  else
    (. /etc/os-release && echo "${VERSION_CODENAME:-}") 2>/dev/null || true
  fi
}

# archive_of <release>: the first Debian archive that apt of this machine takes it from. It reads on
# to the last one, for apt-get fails where nobody does.
archive_of() {
  apt-get indextargets --format '$(COMPONENT) $(REPO_URI) $(RELEASE) $(CODENAME)' \
    'Created-By: Packages' |
    awk -v name="$1" '{if ($3 == "unstable") $3 = "sid"}
      $1 == "main" && ($3 == name || $4 == name) && !found++ {print $2}'
}

debian_archive() { archive_of "$(debian_release)"; }

# Ends before anything is built unless the arguments of a benchmark say where its results go. Its
# Python script reads them.
needs_results() {
  local word
  for word in "$@"; do
    case $word in -o | --output | --output=* | --update) return ;; esac
  done
  fail "say where results go: --output FOLDER, or --update to write over those of the repository"
}
