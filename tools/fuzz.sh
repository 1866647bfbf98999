#!/bin/sh
# Looks for input that a reader cannot stand: every target of tests/fuzz under libFuzzer with the address and undefined
# behavior sanitizers, one after the other.
#
#   tools/fuzz.sh MINUTES [TARGET...]
#
# each for so many minutes or a million executions, whichever comes first. What is found is kept in
# build/fuzz/found/TARGET; once it is mended it belongs in tests/fuzz/regressions/TARGET. JOBS (all processors) compile.
set -eu
[ $# -ge 1 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
minutes=$1
jobs=${JOBS:-$(nproc)}
shift
cd "$(dirname "$0")/.."
command -v clang++ >/dev/null || { echo "there is no clang++: apt-get install clang" >&2; exit 4; }
cmake --preset release >/dev/null
cmake --build build/release --parallel "$jobs" --target gracilis_toolkit
cmake -S tests/fuzz -B build/fuzz -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ >/dev/null
cmake --build build/fuzz --parallel "$jobs"
[ $# -gt 0 ] || set -- $(ls tests/fuzz/seeds)
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks_of_others.txt:print_suppressions=0"
failed=0
for target in "$@"; do
  mkdir -p "build/fuzz/corpus/$target" "build/fuzz/found/$target"
  if GRACILIS_FUZZ_TARGET=$target build/fuzz/bin/fuzz_readers -max_total_time=$((60 * minutes)) -runs=1000000 \
    -rss_limit_mb=2048 -timeout=20 -print_final_stats=1 -dict=tests/fuzz/dictionaries/text.dict -artifact_prefix="build/fuzz/found/$target/" \
    "build/fuzz/corpus/$target" "tests/fuzz/seeds/$target" 2>"build/fuzz/$target.log"; then
    result=clean
  else
    result="FOUND SOMETHING, see build/fuzz/$target.log"
    failed=1
  fi
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$target.log") executions, $result"
done
exit $failed
