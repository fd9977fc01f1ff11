#!/usr/bin/env bash
# Builds and compares fix rbc/fluid with LAMMPS's fix lb/fluid in start-up of Couette flow, error
# against run time, on one core: couette_start.csv and couette_start.png. Takes 12 minutes with
# --repeats 1.
#   usage: couette_start.sh --output FOLDER|--update [--repeats n]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc lb_fluid
LMP_RBC=$BUILD/lmp_rbc LB_FLUID=$BUILD/lb_fluid.so "$PYTHON" "$ROOT/bench/couette_start.py" "$@"
