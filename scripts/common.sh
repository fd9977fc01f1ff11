# Shared by the scripts of this folder: where things are kept and how they are built.
set -euo pipefail

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
CACHE=${USER_RBC_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/user-rbc}
BUILD=${USER_RBC_BUILD:-$ROOT/build}
JOBS=${USER_RBC_JOBS:-$(nproc)}
# Debian's own interpreter: the modules come as Debian packages, and another python3 may be on the PATH.
PYTHON=/usr/bin/python3
export CCACHE_DIR=$CACHE/ccache

# Open MPI refuses root and too many ranks by default; containers and small test machines need both.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
export OMPI_MCA_hwloc_base_binding_policy=none
export OMP_NUM_THREADS=1

say() { printf '== %s\n' "$*"; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}
