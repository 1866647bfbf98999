#!/usr/bin/env bash
# What Cervenka and Kohout (2020) showed of position based dynamics: 1 rad of hip flexion in 100 frames, back in 100, 100 of rest, for
# four muscles of the cadaver, and a box squeezed between two plates; Figures 1 to 21 and Table 1. Three minutes of processor time.
#   reproductions/cervenka-kohout-2020/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/curves/MUSCLE.csv (a row per frame), OUT/summary.csv (published beside ours), the plots of both runs, and OUT/index.html.
# --thin: the box alone.
# Exit code 1: the page lacks something, a muscle's volume was off by 1 % or more, or the box did not come back.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" cervenka-kohout-2020 "$@"
mkdir -p "$out/curves"

# The box needs no data, and a folder that is not there is refused.
from=()
[[ -d $data ]] && from=(--data "$data")

# run NAME SCENE: a missed gate (exit code 5) is no reason to stop, the curves are there all the same.
run() {
  is_finished "$out/$1" && return
  "$gracilis" run "$2" "${from[@]}" "${more[@]}" --out "$out/$1" --layout surfaces --force >"$out/$1.txt" 2>&1 ||
    [[ -f $out/$1/plots/angles.svg ]] || {
    echo "$1: failed, see $out/$1.txt" >&2
    exit 1
  }
}

# curves NAME: a table per muscle from the run's measures, with volume error (%), mean edge ratio and mean change of dihedral angles (degrees).
curves() {
  awk -F, -v folder="$out/curves" '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    {
      file = folder "/" $at["muscle"] ".csv"
      if (!(file in seen)) {
        seen[file] = 1
        print "frame,volume_error_percent,mean_edge_ratio,mean_dihedral_change_deg,vertex_depth_mm,milliseconds" >file
      }
      printf "%d,%.5f,%s,%s,%s,%s\n", $at["frame"], 100 * ($at["volume_ratio"] - 1), $at["edge_ratio_mean"],
        $at["dihedral_change_mean_deg"], $at["vertex_depth_mm"], $at["milliseconds"] >>file
    }' "$out/$1/measures.csv"
}

run box "$root/scenes/box_squeeze/cervenka_kohout_2020.toml"
curves box
if [[ -n $thin ]]; then
  echo "muscles skipped: --thin" >&2
elif has lhdl-hip; then
  run hip "$root/scenes/lhdl_hip/cervenka_kohout_2020.toml"
  curves hip
fi

# cell FILE FRAME COLUMN: a value of a curve.
cell() { awk -F, -v frame="$2" -v column="$3" '$1 == frame { print $column }' "$1"; }
largest_error() { awk -F, 'NR > 1 { e = $2 < 0 ? -$2 : $2; if (e > most) most = e } END { printf "%.3f", most }' "$1"; }
frame_rate() { awk -F, 'NR > 2 { sum += $6; ++n } END { printf "%.1f", 1000 * n / sum }' "$1"; }
# told FILE WORD: the last number that `inspect` tells of a surface in a line that begins with the word.
told() { "$gracilis" inspect "$1" | awk -v word="$2:" '$1 == word { print $NF }'; }

# ours MUSCLE QUANTITY: what our run has; nothing where there is no run.
ours() {
  local file=$out/curves/$1.csv frames=$out/hip/frames frame=${2##*_}
  [[ $1 == box ]] && frames=$out/box/frames
  [[ -f $file ]] || return 0
  case $2 in
    triangles) told "$frames/$1_0000.vtp" triangles ;;
    frames_per_second) frame_rate "$file" ;;
    largest_volume_error) largest_error "$file" ;;
    volume_error_in_frame_*) cell "$file" "$frame" 2 ;;
    mean_edge_ratio_in_frame_*) cell "$file" "$frame" 3 ;;
  esac
}

{
  echo "muscle,quantity,published,ours,unit,source"
  tail -n +2 "$here/published.csv" | while IFS=, read -r muscle quantity published unit source; do
    echo "$muscle,$quantity,$published,$(ours "$muscle" "$quantity"),$unit,$source"
  done
} >"$out/summary.csv"
column -s, -t "$out/summary.csv" 2>/dev/null || cat "$out/summary.csv"

if [[ -z $thin ]]; then
  if [[ -d $data/lhdl-hip ]]; then
    quietly "$out/fibers.txt" "$gracilis" fibers "$root/scenes/lhdl_hip/cervenka_kohout_2020.toml" --data "$data" --only gluteus_maximus_r --out "$out/fibers"
    quietly "$out/surface_fibers.txt" "$gracilis" fibers "$root/scenes/lhdl_hip/superficial_fibers.toml" --data "$data" --out "$out/surface_fibers"
  fi
  python3 -B "$root/reproductions/family/pictures.py" "$gracilis" "$out" "$here"
fi
missed=0
python3 -B "$here/make.py" "$out" "$here" $complete || missed=1
echo "$out/index.html"

# The bars: every muscle's volume within 1 % in every frame, the box's when it has come to rest.
bar() {
  awk -v error="$2" 'BEGIN { exit !(error < 1 && error > -1) }' && return
  echo "$1: volume off by $2 %" >&2
  missed=1
}
bar "box, last frame" "$(cell "$out/curves/box.csv" 300 2)"
for file in "$out"/curves/*_r.csv; do
  [[ -f $file ]] && bar "$(basename "$file" .csv)" "$(largest_error "$file")"
done
exit "$missed"
