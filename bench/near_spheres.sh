#!/usr/bin/env bash
# Rigid spheres near a plate and near each other: near_spheres.csv and near_spheres.png (five
# minutes).
#   usage: near_spheres.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 near_spheres
"$PYTHON" "$ROOT/bench/near_spheres.py" --program "$BUILD/near_spheres" "$@"
