#!/usr/bin/env bash
# opensim.sh FOLDER [GRACILIS]: what becomes of every .osim file below FOLDER. Each is inspected, imported, its muscles' paths
# measured through a sweep, and ten frames of it run by method "cylinder"; each step with a limit of time (SECONDS_EACH, 120) and
# of address space (MEGABYTES_EACH, 8000). Prints a table, a file per line:
#   ok        done
#   refused   not read, with a message that says why (printed below the table)
#   none      nothing to do: no coordinate or no muscle
#   CRASH, TIME, MEMORY, SILENT (refused without a message): faults; then the exit code is 1.
set -u
folder=${1:?usage: opensim.sh FOLDER [GRACILIS]}
program=${2:-$(dirname "$0")/../../build/release/bin/gracilis}
seconds=${SECONDS_EACH:-120}
megabytes=${MEGABYTES_EACH:-8000}
[ -x "$program" ] || { echo "opensim.sh: no program $program" >&2; exit 2; }
[ -d "$folder" ] || { echo "opensim.sh: no folder $folder" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
faults=0
reasons=""

# step NAME ARGUMENT...: runs the program within the limits; sets $said to what became of it.
step() {
  local name=$1
  shift
  ( ulimit -v $((megabytes * 1024)); exec timeout --kill-after=5 "$seconds" "$program" "$@" ) \
    >"$work/out" 2>"$work/err" </dev/null
  local code=$?
  case $code in
    0) said=ok ;;
    2 | 3 | 4 | 5)
      if grep -q '^error: ' "$work/err"; then
        said=refused
        reasons+="$file: $name: $(grep -m1 '^error: ' "$work/err")"$'\n'
      else
        said=SILENT
      fi ;;
    124 | 137) said=TIME ;;
    *) if grep -qi 'memory\|bad_alloc' "$work/err"; then said=MEMORY; else said=CRASH; fi ;;
  esac
  case $said in [A-Z]*)
    faults=$((faults + 1))
    reasons+="$file: $name: exit code $code: $(tail -n1 "$work/err")"$'\n' ;;
  esac
}

# The model's first coordinate by its name, as 'inspect' lists them.
first_coordinate() {
  timeout "$seconds" "$program" inspect "$1" 2>/dev/null | sed -n '/^ *coordinates:/{n;s/^ *//;p;q}'
}

printf '%-9s %-9s %-9s %-9s %s\n' inspect import paths cylinder file
while IFS= read -r -d '' file; do
  rm -rf "$work/scene" "$work/paths" "$work/run" "$work/move.mot"
  import=none paths=none cylinder=none
  step inspect inspect "$file"
  inspect=$said
  coordinate=$(first_coordinate "$file")
  if [ -n "$coordinate" ]; then
    {
      printf 'move\nversion=1\nnRows=10\nnColumns=2\ninDegrees=yes\nendheader\ntime\t%s\n' "$coordinate"
      for row in 0 1 2 3 4 5 6 7 8 9; do printf '0.%s\t0.%s\n' "$row" "$row"; done
    } >"$work/move.mot"
    step paths paths "$file" --coord "$coordinate=0:0.5:0.1" --out "$work/paths"
    paths=$said
    step import import "$file" --motion "$work/move.mot" --out "$work/scene"
  else
    step import import "$file" --out "$work/scene"
  fi
  import=$said
  scene=$(find "$work/scene" -maxdepth 1 -name '*.toml' ! -name model.toml 2>/dev/null | head -n1)
  if [ "$import" = ok ] && [ -n "$scene" ]; then
    step cylinder run "$scene" --set method=cylinder --out "$work/run"
    cylinder=$said
  fi
  printf '%-9s %-9s %-9s %-9s %s\n' "$inspect" "$import" "$paths" "$cylinder" "$file"
done < <(find "$folder" -type f -name '*.osim' -print0 | sort -z)
[ -z "$reasons" ] || printf '\n%s' "$reasons"
[ "$faults" -eq 0 ]
