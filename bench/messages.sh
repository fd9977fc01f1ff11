#!/usr/bin/env bash
# Messages and bytes that a rank sends in a solve of dense blood, with as many cells for each rank
# on 1, 8, 27 and 64 ranks, and what latency and bandwidth of a network make of them on up to
# 100,000: messages.csv and messages.png.
#   usage: messages.sh --output FOLDER|--update [--ranks n ...] [--cells n]
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"

"$ROOT/scripts/build.sh" 4Feb2025 lmp_rbc count_messages
"$PYTHON" "$ROOT/bench/messages.py" --lmp "$BUILD/lmp_rbc" --counter "$BUILD/count_messages.so" "$@"
