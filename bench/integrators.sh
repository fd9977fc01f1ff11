#!/usr/bin/env bash
# Error against solves of the integrators of fix rbc/ib for a red cell in shear flow: healthy, stiff against area, and
# with the moduli as printed in Table 2. Writes integrators.csv and integrators.png.
. "$(dirname "$0")/../scripts/common.sh"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
output=$BUILD/integrators
mkdir -p "$output"
cd "$output"
"$PYTHON" "$ROOT/bench/integrators.py" --lmp "$BUILD/lmp_rbc" --potentials "$ROOT/potentials" \
  --output "$ROOT/bench/integrators" "$@"
