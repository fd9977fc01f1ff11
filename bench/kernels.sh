#!/usr/bin/env bash
# Times the solver's parts on one rank, and on the given number of ranks; prints a table and writes
# kernels.csv.
#   usage: kernels.sh [ranks] --output FOLDER|--update
. "$(dirname "$0")/../scripts/common.sh"
needs_results "$@"
ranks_wanted=1
if [[ $1 =~ ^[1-9][0-9]*$ ]]; then
  ranks_wanted=$1
  shift
fi

"$ROOT/scripts/build.sh" 4Feb2025 kernels

results=()
for ranks in $(printf '%s\n' 1 "$ranks_wanted" | sort -nu); do
  say "timing on $ranks rank(s)"
  result=$BUILD/kernels.$ranks.json
  mpiexec -n "$ranks" "$BUILD/kernels" --benchmark_format=json > "$result"
  results+=("$result")
done
"$PYTHON" "$ROOT/bench/kernels.py" "${results[@]}" "$@"
