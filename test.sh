#!/usr/bin/env bash
# Installs what is missing, builds Gracilis and runs its tests; ends with one line that counts them.
#   ./test.sh           what a change must pass
#   ./test.sh --quick   what takes less than a minute of it, for while one works
#   ./test.sh --long    also the whole motions that take long
#   ./test.sh --asan    the same tests in a build with address and undefined behavior sanitizers
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source tools/set_up.sh

preset=release
targets=()
selection=(--label-exclude '^long$')
for option in "$@"; do
  case $option in
    --quick)
      targets=(quick_tests)
      selection=(--label-regex '^quick$')
      ;;
    --long) selection=() ;;
    --asan) preset=asan ;;
    *)
      echo "usage: ./test.sh [--quick | --long] [--asan]" >&2
      exit 2
      ;;
  esac
done

install_packages
build "$preset" "${targets[@]}"

results=$PWD/build/$preset/test_results.xml
rm -f "$results"
status=0
ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error "${selection[@]}" --output-junit "$results" || status=$?
[[ -f $results ]] || exit 1

# Counted by test case. CTest also calls "skipped" what it could not start: that is a failure here.
passed=$(grep -c '<testcase .*status="run"' "$results" || true)
skipped=$(grep -c -e '<skipped message="SKIP_' -e '<testcase .*status="disabled"' "$results" || true)
total=$(grep -c '<testcase ' "$results" || true)
failed=$((total - passed - skipped))
echo
echo "$passed passed, $failed failed, $skipped skipped"
((status == 0 && failed == 0 && passed > 0))
