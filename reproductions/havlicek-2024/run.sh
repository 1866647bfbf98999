#!/usr/bin/env bash
# Extended position based dynamics (Havlíček 2024): Table B.1, fiber lengths as in Figures 7.10 and 7.11 of XPBD with 70 iterations, passive
# and active, and PBD with 3, Figures 7.1, 7.4 to 7.6 and A.5 to A.14, and a sweep of step sizes for explosions (section 6.6.2). On the
# cadaver's hip, whose activations static optimization finds for poses all over its joint's range; without the data, on the built-in hip with
# an active iliacus, and without the motions by the joint control unit.
# Ten minutes of one core.
#   reproductions/havlicek-2024/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: two muscles, 10 degrees of the built-in hip and of
# each of the cadaver's motions.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" havlicek-2024 "$@"
steps=(10 5 2 0.5) flexion=90 cadaver=yes only=gluteus_maximus_r,gluteus_medius_r,iliacus_r,adductor_brevis_r # section 7.1
every=10 step=1
declare -A farthest=([flexion]=90,0,0 [extension]=-40,0,0 [abduction]=0,-45,0 [rotation]=0,0,60) # Figures 7.1 and 7.4 to 7.6
declare -A view=([flexion]=anterior [extension]=posterior [abduction]=anterior [rotation]=anteromedial)
declare -A shown=([flexion]=26,56,96 [extension]=16,36,46 [abduction]=16,41,51 [rotation]=21,51,66) # after 6 from the capture pose
[[ -z $thin ]] || {
  steps=(5) flexion=10 only=gluteus_maximus_r,iliacus_r every=60 step=5
  farthest=([flexion]=10,0,0 [extension]=-10,0,0 [abduction]=0,-10,0 [rotation]=0,0,10)
}
has_data=
[[ ! -d $data/lhdl-hip || ! -d $data/opensim ]] || has_data=yes
[[ -z $thin && -n $has_data ]] || cadaver=

# Samples for the hip's joint control unit (section 6.5.1): motions through its range, and their activations by static optimization.
sample_activations() {
  local model=$data/opensim/subject01_simbody_adjusted_StaticOp.osim motion name
  [[ -f $out/samples.sto ]] && return
  quietly "$out/motions.txt" "$gracilis" motions "$model" --joint hip_r --combined none \
    --range hip_flexion_r=-40:90 --range hip_adduction_r=-45:20 --range hip_rotation_r=-40:60 --out "$out/motions"
  mkdir -p "$out/activations"
  for motion in "$out"/motions/*.mot; do
    name=$(basename "$motion" .mot)
    quietly "$out/optimization.txt" "$gracilis" static-optimization --model "$model" --motion "$motion" --every "$every" \
      --forces "$data/opensim/gait2392_SO_weak_Residual_Actuators.xml" --out "$out/optimized/$name"
    cp "$out/optimized/$name/gracilis_StaticOptimization_activation.sto" "$out/activations/$name.sto"
  done
  quietly "$out/samples.txt" "$gracilis" activations join "$out/motions" "$out/activations" \
    --map "$root/scenes/lhdl_hip/gait2392_names.toml" --out "$out/samples.sto"
}

# hip NAME PRESET passive|active STEP OPTION...: flexion of the hip into OUT/NAME. One that explodes ends with exit code 5, after the frames before.
hip() {
  local name=$1 preset=$2 kind=$3 step=$4 scene=$here/hip.toml
  is_finished "$out/$name" && return
  shift 4
  mkdir -p "$(dirname "$out/$name")"
  if [[ -n $cadaver ]]; then
    [[ $kind == passive ]] || scene=$out/active.toml
    set -- run "$scene" --data "$data" --set "preset=$preset" --set "motion.step_deg=$step" "$@"
  else
    [[ $kind == passive ]] || set -- --activation iliacus_r=0.3 "$@"
    set -- demo --flexion "$flexion" --step "$step" --preset "$preset" "$@"
  fi
  quietly "$out/$name.txt" "$gracilis" "$@" --only "$only" "${more[@]}" --metrics light --no-pictures --out "$out/$name" --force
}

# controlled MOTION PRESET: the cadaver's muscles driven by the joint control unit, into OUT/controlled.
controlled() {
  local folder=$out/controlled/$1_$2
  is_finished "$folder" && return
  mkdir -p "$out/controlled"
  quietly "$folder.txt" "$gracilis" run "$out/active.toml" --data "$data" --set "preset=$2" --set "motion.step_deg=$step" \
    --set "motion.key_poses_deg=[[0,0,0],[${farthest[$1]}]]" --only "$only" "${more[@]}" --metrics light --no-pictures --out "$folder" --force
}

if [[ -n $has_data ]]; then
  sample_activations
  cat >"$out/active.toml" <<END
schema = 1
name = "havlicek_2024_active_hip"
include = "$here/hip.toml"
[[joint_control_units]]
name = "hip_r"
joint = "hip_r"
samples = "$out/samples.sto"
END
  for motion in flexion extension abduction rotation; do
    for preset in thesis-2024 physical; do
      [[ -n $thin && $preset == physical ]] || controlled "$motion" "$preset"
    done
  done
fi
hip passive thesis-2024 passive 1
hip active thesis-2024 active 1
hip pbd pbd-2020 passive 1
for kind in passive active; do
  for step in "${steps[@]}"; do hip "sweep/${kind}_$step" thesis-2024 "$kind" "$step" --no-fibers; done
done
frames=20,50,90
[[ -z $cadaver ]] || frames=26,56,96 # after 6 from the capture pose to the motion's first
if [[ -z $thin ]]; then
  for each in passive active pbd; do
    for side in anterior lateral; do
      quietly "$out/picture_$each.txt" "$gracilis" render "$out/$each" --frames "$frames" --view "$side" --out "$out/${each}_$side.png"
    done
  done
  [[ -z $has_data ]] || for motion in "${!shown[@]}"; do
    for preset in thesis-2024 physical; do
      folder=$out/controlled/${motion}_$preset
      quietly "$folder.picture.txt" "$gracilis" render "$folder" --frames "${shown[$motion]}" --view "${view[$motion]}" --out "$folder.png"
    done
  done
fi
"$gracilis" print-config >"$out/config.toml"
python3 -B "$here/make.py" "$out" "$here"
echo "$out/index.html"
