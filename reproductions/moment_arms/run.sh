#!/usr/bin/env bash
# Moment arms by every method beside published ones: the cadaver's hip, and the elbow and knee beside what OpenSim models have.
#   reproductions/moment_arms/run.sh [--methods strings,xpbd] [--joints hip,elbow,knee] [--step 2] [--data FOLDER] [--out FOLDER]
# Leaves OUT/summary.csv, a row per method, coordinate, muscle and source, and the plots of each run.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
methods=strings,xpbd,tissue,skinning
joints=hip,elbow,knee
step=2
data=${GRACILIS_DATA:-$root/../shared/data}
out=$root/out/moment_arms
while (($#)); do
  case $1 in
    --methods) methods=$2 ;;
    --joints) joints=$2 ;;
    --step) step=$2 ;;
    --data) data=$2 ;;
    --out) out=$2 ;;
    *)
      echo "usage: run.sh [--methods M,...] [--joints J,...] [--step DEGREES] [--data FOLDER] [--out FOLDER]" >&2
      exit 2
      ;;
  esac
  shift 2
done
gracilis=${GRACILIS:-$root/build/release/bin/gracilis}
validation=$data/validation
[[ -d $validation ]] || {
  echo "skipped: there is no $validation" >&2
  exit 0
}
source "$root/reproductions/family/stamp.sh"
begin_in "$out" "$gracilis" --step "$step" --data "$data"
summary=$out/summary.csv

# sweep METHOD NAME SCENE DATA COORDINATE=FROM:TO:STEP REFERENCE [more options of rom]
sweep() {
  local method=$1 name=$2 scene=$3 scene_data=$4 coordinate=$5 reference=$6
  shift 6
  local folder=$out/$method/$name
  if ! { is_finished "$folder" && [[ -f $folder/reference.csv ]]; }; then
    # A missed gate (exit code 5) is no reason to stop: arms are there all the same.
    "$gracilis" rom "$scene" --data "$scene_data" --coord "$coordinate" --reference "$reference" --set method="$method" \
      --out "$folder" --force "$@" >"$out/$method-$name.txt" 2>&1 || [[ -f $folder/reference.csv ]] || {
      echo "$method, $name: failed, see $out/$method-$name.txt" >&2
      return
    }
  fi
  awk -v start="$method,${coordinate%%=*}" 'NR > 1 { print start "," $0 }' "$folder/reference.csv" >>"$summary"
}

# The scenes have some names of their own.
for motion in flexion adduction; do
  sed 's/^psoas_r,/psoas_major_r,/' "$validation/modenese_kohout_2020_hip_$motion.csv" >"$out/hip_$motion.csv"
done
sed -e 's/elbow_flexion_r/elbow_flexion/; s/biceps_brachii_r/biceps_long/; s/\(triceps_[a-z]*\)_r/\1/' \
  "$validation/models_elbow_knee_ankle.csv" >"$out/models_elbow.csv"
hip=$root/scenes/lhdl_hip/hip.toml
at_zero=(--coord hip_rotation_r=0)

echo "method,coordinate,muscle,source,angles,from_deg,to_deg,rms_mm,largest_mm,slope_mm_per_deg,reference_slope_mm_per_deg,beyond_band_mm" >"$summary"
for method in ${methods//,/ }; do
  if [[ ,$joints, == *,hip,* ]]; then
    sweep "$method" hip_flexion "$hip" "$data" hip_flexion_r=-10:60:"$step" "$out/hip_flexion.csv" \
      --coord hip_adduction_r=0 "${at_zero[@]}"
    sweep "$method" hip_adduction "$hip" "$data" hip_adduction_r=-40:20:"$step" "$out/hip_adduction.csv" \
      --coord hip_flexion_r=0 "${at_zero[@]}"
  fi
  [[ ,$joints, != *,elbow,* ]] ||
    sweep "$method" elbow "$data/elbow/elbow.toml" "$data/elbow" elbow_flexion=20:120:"$step" "$out/models_elbow.csv"
  [[ ,$joints, != *,knee,* ]] ||
    sweep "$method" knee "$data/leg/leg.toml" "$data/leg" knee_flexion_r=0:90:"$step" "$validation/models_elbow_knee_ankle.csv"
done
column -s, -t "$summary" 2>/dev/null || cat "$summary"
