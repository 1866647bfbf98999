#!/usr/bin/env bash
# Mass-spring systems (Janák 2012): Figures 5.3 to 5.5, 5.9 to 5.11, 5.17 and 5.18, Tables 5.1 to 5.3, on the cadaver's hip, turned from the
# scan's pose to 60 degrees of flexion at once. Ten minutes of one core.
#   reproductions/janak-2012/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: two layouts, 100 iterations at most.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" janak-2012 "$@"
[[ -d $data/lhdl-hip ]] || {
  echo "skipped: there is no $data/lhdl-hip" >&2
  exit 0
}
layouts=(cubic-6 cubic-26 delaunay nearest) counts=(10 20 50 100 200 500 1000 1500) neighbors=(10 15 20 25) resolutions=(20 40 60 80)
steps=(25 50 75 100 150 200)
[[ -z $thin ]] || { layouts=(cubic-6 nearest) counts=(10 100) neighbors=(10 20) resolutions=(20 40) steps=(25 100); }

# hip NAME KEY=VALUE...: one frame of the published preset with these settings, on one thread: times are processor time.
hip() {
  local folder=$out/runs/$1 set=() setting
  is_finished "$folder" && return
  shift
  for setting in "$@"; do set+=(--set "$setting"); done
  quietly "$folder.txt" "$gracilis" run "$root/scenes/lhdl_hip/flexion_at_once.toml" --data "$data" --set preset=janak-2012 \
    --set sequence.ramp_frames=1 "${set[@]}" "${more[@]}" --threads 1 --no-fibers --metrics light --no-pictures --out "$folder" --force
}
mkdir -p "$out/runs"

# Figures 5.3 to 5.5: how fast particles come to rest, by layout and number of neighbors.
for count in "${counts[@]}"; do
  for layout in "${layouts[@]}"; do hip "layout_${layout}_$count" layout="$layout" neighbors=15 iterations="$count"; done
  for each in "${neighbors[@]}"; do hip "neighbors_${each}_$count" layout=nearest neighbors="$each" iterations="$count"; done
done
# Table 5.1: 70 iterations with trees rebuilt and only refitted, and without collisions.
alone=(bone_collision=none muscle_collision=false)
hip rebuilt iterations=70 refit_only=false
hip refitted iterations=70 refit_only=true
hip springs_70 iterations=70 "${alone[@]}"
# Figures 5.9 to 5.11: changes of length by time step.
for count in 1 "${steps[@]}"; do
  hip "step_0.4_$count" iterations="$count" verlet_step=0.4 smallest_step=0
  hip "step_0.7_$count" iterations="$count" verlet_step=0.7 smallest_step=0
  hip "step_adaptive_$count" iterations="$count" verlet_step=0.4 smallest_step=0.04
done
# Tables 5.2 and 5.3, figures 5.17 and 5.18: particles per fiber, 100 iterations.
for each in "${resolutions[@]}"; do
  hip "resolution_$each" iterations=100 particles_per_fiber="$each" refit_only=true neighbors=18
  hip "resolution_alone_$each" iterations=100 particles_per_fiber="$each" neighbors=18 "${alone[@]}"
done
python3 -B "$here/make.py" "$out" "$here"
echo "$out/index.html"
