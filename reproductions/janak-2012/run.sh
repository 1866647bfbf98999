#!/usr/bin/env bash
# Mass-spring systems (Janák 2012): Figures 5.3 to 5.18 and Tables 5.1 to 5.3, on the cadaver's hip, turned from the scan's pose to 60 degrees
# of flexion at once, and on the thigh of OpenSim's walking model, thirteen muscles as published, taken from its default pose to those of a
# walk at once. Half an hour of one core.
#   reproductions/janak-2012/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: two layouts, 100 iterations at most, two muscles of the
# thigh, no pictures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" janak-2012 "$@"
has lhdl-hip || exit 0
layouts=(cubic-6 cubic-26 delaunay nearest) counts=(10 20 50 100 200 500 1000 1500) neighbors=(10 15 20 25) resolutions=(20 40 60 80)
steps=(25 50 75 100 150 200) many=(300 500) instants=(0.5 0.89 1.27 1.66 1.99) # of the walk, s: as far through it as the published ones
thigh=rect_fem_r,semiten_r,semimem_r,sar_r,vas_med_r,vas_int_r,vas_lat_r,add_brev_r,add_long_r,add_mag2_r,grac_r,pect_r,bifemlh_r # Table 5.2
[[ -z $thin ]] || {
  layouts=(cubic-6 nearest) counts=(10 100) neighbors=(10 20) resolutions=(20 40) steps=(25 100) many=() instants=(0.5) thigh=sar_r,grac_r
}

# frame NAME SCENE OPTION... -- KEY=VALUE...: one frame of the published preset with these settings, on one thread: times are processor time.
frame() {
  local folder=$out/runs/$1 scene=$2 options=() setting
  is_finished "$folder" && return
  shift 2
  while [[ $1 != -- ]]; do options+=("$1") && shift; done
  shift
  for setting in "$@"; do options+=(--set "$setting"); done
  quietly "$folder.txt" "$gracilis" run "$scene" --set preset=janak-2012 --set sequence.ramp_frames=1 "${options[@]}" "${more[@]}" --threads 1 \
    --metrics light --no-pictures --out "$folder" --force
}
hip() {
  local name=$1
  shift
  frame "$name" "$root/scenes/lhdl_hip/flexion_at_once.toml" --data "$data" --no-fibers -- "$@"
}
# leg NAME SECOND KEY=VALUE...
leg() {
  local name=leg_$1 second=$2
  shift 2
  frame "$name" "$out/leg/subject01_walk1_Kinematics.toml" --set "motion.begin=$second" --set "motion.end=$second" -- "$@"
}
mkdir -p "$out/runs"
alone=(bone_collision=none muscle_collision=false)

# Figures 5.3 to 5.5: how fast particles come to rest, by layout and number of neighbors.
for count in "${counts[@]}"; do
  for layout in "${layouts[@]}"; do hip "layout_${layout}_$count" layout="$layout" neighbors=15 iterations="$count"; done
  for each in "${neighbors[@]}"; do hip "neighbors_${each}_$count" layout=nearest neighbors="$each" iterations="$count"; done
done
# Table 5.1: 70 iterations with trees rebuilt and only refitted, with each kind of collision, and without.
collisions() {
  "$@" rebuilt iterations=70 refit_only=false
  "$@" refitted iterations=70 refit_only=true
  "$@" of_muscles iterations=70 refit_only=false bone_collision=none
  "$@" of_bones iterations=70 refit_only=false muscle_collision=false
  "$@" springs_70 iterations=70 "${alone[@]}"
}
# Figures 5.9 to 5.11: changes of length by time step.
time_steps() {
  for count in 1 "${steps[@]}"; do
    "$@" "step_0.4_$count" iterations="$count" verlet_step=0.4 smallest_step=0
    "$@" "step_0.7_$count" iterations="$count" verlet_step=0.7 smallest_step=0
  done
  for count in 1 "${steps[@]}" "${many[@]}"; do "$@" "step_adaptive_$count" iterations="$count" verlet_step=0.4 smallest_step=0.04; done
}
# Tables 5.2 and 5.3, figures 5.17 and 5.18: particles per fiber, 100 iterations.
resolution() {
  local name=$1 each
  shift
  for each in "${resolutions[@]}"; do
    "$@" "${name}_$each" iterations=100 particles_per_fiber="$each" refit_only=true neighbors=18
    "$@" "${name}_alone_$each" iterations=100 particles_per_fiber="$each" neighbors=18 "${alone[@]}"
  done
}
collisions hip
time_steps hip
resolution resolution hip

if has opensim; then
  rm -rf "$out/leg"
  quietly "$out/leg.txt" "$gracilis" import "$data/opensim/subject01_simbody_adjusted_StaticOp.osim" --geometry "$data/opensim/geometry" \
    --muscles "$thigh" --motion "$data/opensim/subject01_walk1_Kinematics.sto" --out "$out/leg"
  # with its place in the walk between its name and its settings
  at() { leg "$2" "$1" "${@:3}"; }
  for second in "${instants[@]}"; do resolution "at_$second" at "$second"; done
  if [[ -z $thin ]]; then
    collisions at "${instants[0]}"
    time_steps at "${instants[0]}"
    # Figures 5.6 to 5.8, 5.12, 5.15 and 5.16.
    for layout in "${layouts[@]}"; do leg "after_1500_$layout" "${instants[0]}" layout="$layout" neighbors=15 iterations=1500; done
    leg after_3000 "${instants[0]}" layout=cubic-26 iterations=3000
    leg carried "${instants[0]}" iterations=1
    leg long_steps "${instants[0]}" iterations=1000 verlet_step=0.7 smallest_step=0
    for each in 3 8; do leg "surface_$each" "${instants[0]}" iterations=1000 verlet_step=0.7 smallest_step=0 surface_particles="$each"; done
  fi
fi
[[ -n $thin ]] || python3 -B "$root/reproductions/family/pictures.py" "$gracilis" "$out" "$here"
python3 -B "$here/make.py" "$out" "$here" $complete
echo "$out/index.html"
