#!/usr/bin/env bash
# Debian's Python with LAMMPS's own module, this package's plugin and the package rbc. Builds what
# is not there yet.
#   usage: python.sh [script.py | -m module] [argument ...]
. "$(dirname "$0")/common.sh"
export USER_RBC_OWN_LAMMPS=1    # Debian's library loads no plugins
. "$(dirname "$0")/lammps_version.sh" 4Feb2025

[ -f "$BUILD/rbcplugin.so" ] && [ -d "$LAMMPS_HOME/source" ] ||
  "$ROOT/scripts/build.sh" 4Feb2025 rbcplugin

export PYTHONPATH=$ROOT/scripts:$LAMMPS_HOME/source/python${PYTHONPATH:+:$PYTHONPATH}
export LD_LIBRARY_PATH=$LAMMPS_BUILD${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export LAMMPS_PLUGIN_PATH=$BUILD${LAMMPS_PLUGIN_PATH:+:$LAMMPS_PLUGIN_PATH}
exec "$PYTHON" "$@"
