#!/bin/sh
# Runs clang-tidy (.clang-tidy) over single sources; ends with 1 where it has something to say.
#
#   tools/tidy.sh FILE...       these
#   tools/tidy.sh --sample N    so many of src/gracilis and apps, drawn by the date of the last commit: each change
#                               meets others, the same change always the same
#
# A file takes about 17 s of a processor, all of them hours, hence samples.
set -eu
[ $# -ge 1 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
cd "$(dirname "$0")/.."
command -v clang-tidy >/dev/null || { echo "skipped: there is no clang-tidy (apt-get install clang-tidy)"; exit 0; }
if [ "$1" = --sample ]; then
  [ $# -eq 2 ] || { echo "--sample takes a number" >&2; exit 2; }
  date=$(git log -1 --format=%ct 2>/dev/null || echo 0)
  # The first so many by the hash of date and name.
  set -- $(for file in $(find src/gracilis apps -name '*.cpp'); do
    echo "$(echo "$date $file" | sha256sum | cut -c1-16) $file"
  done | sort | head -n "$2" | cut -d' ' -f2)
fi
cmake --preset debug -B build/tidy >/dev/null
# GCC's own warnings are not clang's.
printf '%s\n' "$@" | xargs -n 1 -P "$(nproc)" clang-tidy -p build/tidy --quiet --warnings-as-errors='*' \
  --extra-arg=-Wno-unknown-warning-option || { echo "clang-tidy has something to say" >&2; exit 1; }
