#!/usr/bin/env bash
# Every publication's figures and tables again, published beside ours, and one page with a thumbnail of each figure and its command.
#   reproductions/run.sh [--thin] [--only NAME,...] [--data FOLDER] [--out FOLDER]
# Leaves OUT/NAME for each and OUT/index.html. --thin: few frames, coarse copies. Killed, the same line goes on; with other options or
# another version of the program it begins anew.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/.." && pwd)
only=cervenka-2024,cervenka-kohout-2020,havlicek-2024,janak-2012,lacle-2014,modenese-kohout-2020
out=$root/out/reproductions
options=()
while (($#)); do
  case $1 in
    --thin) options+=(--thin) ;;
    --only) only=$2; shift ;;
    --data) options+=(--data "$2"); shift ;;
    --out) out=$2; shift ;;
    *)
      echo "usage: reproductions/run.sh [--thin] [--only NAME,...] [--data FOLDER] [--out FOLDER]" >&2
      exit 2
      ;;
  esac
  shift
done
mkdir -p "$out"
missed=0
for name in ${only//,/ }; do
  [[ -x $here/$name/run.sh ]] || {
    echo "there is no reproduction '$name'" >&2
    exit 2
  }
  "$here/$name/run.sh" "${options[@]}" --out "$out/$name" || {
    echo "$name: failed or missed a bar" >&2
    missed=1
  }
done
python3 -B "$here/family/index.py" "$out" ${only//,/ }
echo "$out/index.html"
exit "$missed"
