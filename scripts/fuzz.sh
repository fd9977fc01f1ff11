#!/usr/bin/env bash
# Builds the targets of libFuzzer with Debian's clang into build-fuzz/ and runs each for some time.
# What a target has found lies in build-fuzz/findings/; given as an argument to the target, such a
# file runs again.
#   usage: fuzz.sh [seconds of each, 600 by default [stl|template|arguments ...]]
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/lammps_version.sh" 4Feb2025

seconds=${1:-600}
targets=("${@:2}")
[ ${#targets[@]} -gt 0 ] || targets=(stl template arguments)
BUILD=${USER_RBC_BUILD:-$ROOT/build-fuzz}

"$ROOT/scripts/dependencies.sh" clang libclang-rt-dev
"$ROOT/scripts/lammps.sh" "$LAMMPS_VERSION"
(cd "$ROOT" && cmake --preset fuzz -B "$BUILD")
cmake --build "$BUILD" -j "$JOBS" --target "${targets[@]/%/_fuzz}"
"$PYTHON" "$ROOT/tests/fuzz/seeds.py" "$BUILD/seeds"

failed=0
for target in "${targets[@]}"; do
  say "fuzzing $target for $seconds s"
  mkdir -p "$BUILD/corpus/$target" "$BUILD/findings"
  "$BUILD/${target}_fuzz" -seed=1 -max_total_time="$seconds" -timeout=300 \
    -rss_limit_mb=4000 -print_final_stats=1 \
    -dict="$BUILD/seeds/$target.dict" -artifact_prefix="$BUILD/findings/$target-" \
    "$BUILD/corpus/$target" "$BUILD/seeds/$target" || failed=1
done
exit $failed
