#!/usr/bin/env bash
# Radial basis functions for muscles (Červenka 2024): Tables 3.1 and 3.2, Figures 5.1 to 5.8, 5.11 and 5.13, and what its model of a muscle
# makes of a flexed hip. The built-in hip needs no data; with them gluteus maximus and attachments of the cadaver. Three minutes of one core.
#   reproductions/cervenka-2024/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours), OUT/tables and OUT/figures. --thin: few functions, two muscles and 10 degrees.
# Needs gracilis_rbf_tables beside gracilis: cmake --build --preset release --target gracilis_rbf_tables
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" cervenka-2024 "$@"
tables=$(dirname "$gracilis")/gracilis_rbf_tables
[[ -x $tables ]] || {
  echo "there is no $tables: cmake --build --preset release --target gracilis_rbf_tables" >&2
  exit 1
}
motion=(--flexion 90 --set fibers.count=15) shown=20,50,90
[[ -z $thin ]] || motion=(--flexion 10 --set fibers.count=5 --set centers=100 --only "gluteus_maximus_r,iliacus_r")

measured=()
! has lhdl-hip leg/patches || measured=(--data "$data")
mkdir -p "$out/tables"
[[ -f $out/tables/done ]] || {
  quietly "$out/tables.txt" "$tables" "$out/tables" $thin "${measured[@]}"
  touch "$out/tables/done"
}

# hip NAME OPTIONS: flexion of the built-in hip.
hip() {
  local name=$1
  shift
  is_finished "$out/$name" || quietly "$out/$name.txt" "$gracilis" demo "${motion[@]}" "$@" "${more[@]}" \
    --metrics light --no-pictures --out "$out/$name" --force
}
hip published --preset rbf-2024
hip completed --set method=rbf
if [[ -z $thin ]]; then
  hip pbd --preset pbd-2020
  for each in published completed pbd; do
    quietly "$out/picture_$each.txt" "$gracilis" render "$out/$each" --frames "$shown" --out "$out/$each.png"
  done
  # Figures 5.4 and 5.8: muscles of position based dynamics, one with its fibers.
  quietly "$out/picture_medius.txt" "$gracilis" render "$out/pbd" --frames 90 --muscles gluteus_medius_r --out "$out/medius.png"
  quietly "$out/picture_iliacus.txt" "$gracilis" render "$out/pbd" --frames 0,45,90 --muscles iliacus_r --hide femur_r --focus iliacus_r --fibers --view anterior \
    --out "$out/iliacus.png"
fi
python3 -B "$here/make.py" "$out" "$here" $complete
echo "$out/index.html"
