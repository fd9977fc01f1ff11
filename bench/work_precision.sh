#!/usr/bin/env bash
# Error of the flow against run time on one core, over spacing, time step, scheme and regime; writes work_precision.csv
# and work_precision.png.
#   usage: work_precision.sh
. "$(dirname "$0")/../scripts/common.sh"

"$ROOT/scripts/build.sh" 4Feb2025 work_precision
"$BUILD/work_precision" | tee "$ROOT/bench/work_precision.csv"
"$PYTHON" "$ROOT/bench/work_precision.py" "$ROOT/bench/work_precision.csv" "$ROOT/bench/work_precision.png"
