#!/usr/bin/env bash
# Sets everything up and runs a healthy red cell in shear flow: numbers, ParaView files and a
# picture in <build folder>/shear-cell. Arguments go to LAMMPS, for example: -var rate 60
. "$(dirname "$0")/common.sh"
"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc rbcplugin

example=$ROOT/examples/shear-cell
output=$BUILD/shear-cell
mkdir -p "$output"
cd "$output"
rm -f cells.*.vtp
ranks=$((JOBS < 2 ? 1 : 2))
say "running examples/shear-cell on $ranks MPI task(s) in $output"
mpirun -np "$ranks" "$BUILD/lmp_rbc" -in "$example/in.shear-cell" \
  -var templates "$ROOT/potentials" "$@"

"$PYTHON" "$example/draw.py" "$output" --output "$output"
say "picture: $output/shear-cell.png; surfaces for ParaView: $output/cells.*.vtp;" \
  "numbers: $output/cell.dat"
