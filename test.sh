#!/usr/bin/env bash
# Installs what is missing, builds Gracilis and runs its tests; ends with one line that counts them.
#   ./test.sh           what a change must pass
#   ./test.sh --quick   what takes less than a minute of it, for while one works
#   ./test.sh --long    also the whole motions that take long
#   ./test.sh --asan    the same tests in a build with address and undefined behavior sanitizers
#   ./test.sh --tsan    the tests of what runs on several threads in a build with the thread sanitizer
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
    --long)
      targets=(all long_tests)
      selection=()
      ;;
    --asan) preset=asan ;;
    --tsan)
      preset=tsan
      targets=(threaded_tests)
      selection=(--label-regex '^(quick|methods|view)$')
      ;;
    *)
      echo "usage: ./test.sh [--quick | --long] [--asan | --tsan]" >&2
      exit 2
      ;;
  esac
done

install_packages
build "$preset" "${targets[@]}"

results=$PWD/build/$preset/test_results.xml
cases=$PWD/build/$preset/test_cases
rm -rf "$results" "$cases"
status=0
ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error "${selection[@]}" --output-junit "$results" || status=$?
[[ -f $results ]] || exit 1

# Counted by test case: where a process ran many (its file is in $cases), those. One that ended without a file counts as
# one that failed. CTest also calls "skipped" what it could not start: that is a failure here.
mkdir -p "$cases"
of_ctest=$(grep '<testcase ' "$results" | grep -v -F -f <(cd "$cases" && printf 'name="%s"\n' * | sed 's/[.]xml"$/"/') || true)
count() { grep -c "$@" || true; }
total=$(count . <<<"$of_ctest")
passed=$(count 'status="run"' <<<"$of_ctest")
skipped=$(count -e '<skipped message="SKIP_' -e '<testcase .*status="disabled"' <"$results")
if compgen -G "$cases/*.xml" >/dev/null; then
  read -r more skipped_more failed_more < <(awk '
    /<testcase / { total++; seen = 0; if (/result="skipped"/) skipped++ }
    /<failure / && !seen { failed++; seen = 1 }
    END { print total + 0, skipped + 0, failed + 0 }' "$cases"/*.xml)
  total=$((total + more))
  passed=$((passed + more - skipped_more - failed_more))
  skipped=$((skipped + skipped_more))
fi
failed=$((total - passed - skipped))
echo
echo "$passed passed, $failed failed, $skipped skipped"
((status == 0 && failed == 0 && passed > 0))
