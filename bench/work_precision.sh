#!/usr/bin/env bash
# Error of the flow against run time on one core, over spacing, time step, scheme and regime:
# work_precision.csv and work_precision.png.
#   usage: work_precision.sh --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 work_precision
"$PYTHON" "$ROOT/bench/work_precision.py" --program "$BUILD/work_precision" "$@"
