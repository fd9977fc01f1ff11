#!/usr/bin/env bash
# Drag of rigid spheres in simple cubic arrays and between plates: drag.csv and drag.png (a minute).
#   usage: drag.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 drag
"$PYTHON" "$ROOT/bench/drag.py" --program "$BUILD/drag" "$@"
