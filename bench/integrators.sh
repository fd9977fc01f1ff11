#!/usr/bin/env bash
# Error against solves of the integrators of fix rbc/ib for a red cell in shear flow: healthy, stiff
# against area, and with the moduli as printed in Table 2. Writes integrators.csv and
# integrators.png.
#   usage: integrators.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc
"$PYTHON" "$ROOT/bench/integrators.py" --lmp "$BUILD/lmp_rbc" "$@"
