#!/usr/bin/env bash
# Cost of a step of 512 adhering red cells at 45 % (162 vertices, dx = 0.8 um, 100 /s) on 2 ranks,
# part by part, over the first 20 steps: suspension.txt. Further arguments go to LAMMPS.
#   usage: suspension.sh --output FOLDER|--update [-var name value ...]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"
case $1 in
  --output)
    mkdir -p "${2:?a folder comes after --output}"
    results=$(cd "$2" && pwd)
    shift 2
    ;;
  --update) results=$ROOT/bench; shift ;;
  *) fail "--output FOLDER or --update comes first" ;;
esac

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
mkdir -p "$BUILD/suspension"
cd "$BUILD/suspension"
mpirun -np 2 "$BUILD/lmp_rbc" -in "$ROOT/bench/in.suspension" \
  -var templates "$ROOT/potentials" -var strain 0.4 -log log.suspension "$@"
grep -A 12 "step cost" log.suspension | tee "$results/suspension.txt"
