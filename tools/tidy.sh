#!/bin/sh
# Runs clang-tidy (.clang-tidy) over sources of src/gracilis and apps; ends with 1 where it has something to say.
#
#   tools/tidy.sh FILE...       these, each alone, with the analyzer too: about 17 s of a processor each
#   tools/tidy.sh --sample N    so many of them, drawn by the date of the last commit: each change meets others, the same
#                               change always the same
#   tools/tidy.sh --units [N]   units of the release build, which compile ten to twenty files as one: 15 s of a processor
#                               each, 20 minutes for all; N: drawn as above
#   tools/tidy.sh --changed N   of what the last commit and edits since then have changed, in N units at most
#
# In units the analyzer and what looks for unused names see nothing, as in all included files. BUILD (build/release) has
# the units.
set -eu
[ $# -ge 1 ] || { sed -n '2,14s/^# \{0,1\}//p' "$0" >&2; exit 2; }
cd "$(dirname "$0")/.."
command -v clang-tidy >/dev/null || { echo "skipped: there is no clang-tidy (apt-get install clang-tidy)"; exit 0; }
build=${BUILD:-build/release}

# The first $1 of the lines, by the hash of the last commit's date and each.
drawn() {
  date=$(git log -1 --format=%ct 2>/dev/null || echo 0)
  while read -r line; do
    echo "$(echo "$date $line" | sha256sum | cut -c1-16) $line"
  done | sort | head -n "$1" | cut -d' ' -f2
}

# Sources of src/gracilis and apps as the build compiles them: most in units.
units() {
  [ -f "$build/compile_commands.json" ] || cmake --preset release >/dev/null
  sed -n 's/^ *"file": "\(.*\)".*/\1/p' "$build/compile_commands.json" |
    grep -E "/(src/CMakeFiles/gracilis_(core|toolkit|prepare)|apps/gracilis/CMakeFiles/gracilis_program)[.]dir/Unity/|^$PWD/(src/gracilis|apps)/"
}

# What changed, as lines of paths; headers as they are.
changed_files() {
  git diff --name-only HEAD~1 -- src/gracilis apps 2>/dev/null | grep -E '[.][ch]pp$' || true
}

# Units that hold one of the files $1, or what is called like one of its headers.
units_of() {
  units | while read -r unit; do
    for file in $1; do
      source=$PWD/${file%.*}.cpp
      if [ "$unit" = "$source" ] || { [ "${unit%.cxx}" != "$unit" ] && grep -qF "\"$source\"" "$unit"; }; then
        echo "$unit"
        break
      fi
    done
  done
}

# clang-tidy over what stands on stdin, a line each. GCC's own warnings are not clang's.
check() {
  xargs -n 1 -P "${JOBS:-$(nproc)}" clang-tidy --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option "$@" || { echo "clang-tidy has something to say" >&2; exit 1; }
}

in_units='--checks=-clang-analyzer-*,-bugprone-suspicious-include'
case $1 in
  --sample)
    [ $# -eq 2 ] || { echo "--sample takes a number" >&2; exit 2; }
    cmake --preset debug -B build/tidy >/dev/null
    find src/gracilis apps -name '*.cpp' | drawn "$2" | check -p build/tidy
    ;;
  --units)
    units | drawn "${2:-1000}" | check -p "$build" "$in_units"
    ;;
  --changed)
    [ $# -eq 2 ] || { echo "--changed takes a number" >&2; exit 2; }
    files=$(changed_files)
    [ -n "$files" ] || { echo "no source has changed"; exit 0; }
    only="($(echo "$files" | sed 's/[.]/[.]/g' | paste -sd'|'))\$"
    units_of "$files" | drawn "$2" | check -p "$build" "$in_units" "--header-filter=$only"
    ;;
  *)
    cmake --preset debug -B build/tidy >/dev/null
    printf '%s\n' "$@" | check -p build/tidy
    ;;
esac
