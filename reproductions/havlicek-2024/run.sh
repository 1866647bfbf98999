#!/usr/bin/env bash
# Extended position based dynamics (Havlíček 2024): Table B.1 and fiber lengths as in Figures 7.10 and 7.11, of XPBD with 70 iterations and
# PBD with 3, on the built-in hip, which needs no data. Three minutes of one core.
#   reproductions/havlicek-2024/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: 10 degrees of flexion instead of 90.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" havlicek-2024 "$@"
flexion=90
[[ -z $thin ]] || flexion=10

# hip NAME PRESET
hip() {
  [[ -f $out/$1/fiber_lengths.sto ]] || quietly "$out/$1.txt" "$gracilis" demo --flexion "$flexion" --preset "$2" "${more[@]}" \
    --set fibers.count=15 --metrics light --out "$out/$1" --force
}
hip xpbd thesis-2024
hip pbd pbd-2020
if [[ -z $thin ]]; then
  for each in xpbd pbd; do
    quietly "$out/picture_$each.txt" "$gracilis" render "$out/$each" --frames 20,50,90 --out "$out/$each.png"
  done
fi
"$gracilis" print-config >"$out/config.toml"
python3 -B "$here/make.py" "$out" "$here"
echo "$out/index.html"
