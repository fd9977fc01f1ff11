#!/usr/bin/env bash
# Drag of rigid spheres, simple cubic arrays and between plates: writes bench/drag.csv and bench/drag.png (a minute).
. "$(dirname "$0")/../scripts/common.sh"

"$ROOT/scripts/build.sh" 4Feb2025 drag
"$BUILD/drag" > "$ROOT/bench/drag.csv"
"$PYTHON" "$ROOT/bench/drag.py"
