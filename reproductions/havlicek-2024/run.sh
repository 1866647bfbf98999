#!/usr/bin/env bash
# Extended position based dynamics (Havlíček 2024): Table B.1, fiber lengths as in Figures 7.10 and 7.11 of XPBD with 70 iterations, passive
# and active, and PBD with 3, Figures 7.1, A.5 and A.6, and a sweep of step sizes for explosions (section 6.6.2). On the cadaver's hip, whose
# activations static optimization finds for poses all over its joint's range; without the data, on the built-in hip with an active iliacus.
# Ten minutes of one core.
#   reproductions/havlicek-2024/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: 10 degrees of the built-in hip, two muscles.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" havlicek-2024 "$@"
steps=(10 5 2 0.5) flexion=90 cadaver=yes only=gluteus_maximus_r,gluteus_medius_r,iliacus_r,adductor_brevis_r # section 7.1
[[ -z $thin ]] || { steps=(5) flexion=10 only=gluteus_maximus_r,iliacus_r; }
[[ -z $thin && -d $data/lhdl-hip && -d $data/opensim ]] || cadaver=

# Samples for the hip's joint control unit (section 6.5.1): motions through its range, and their activations by static optimization.
sample_activations() {
  local model=$data/opensim/subject01_simbody_adjusted_StaticOp.osim motion name
  [[ -f $out/samples.sto ]] && return
  quietly "$out/motions.txt" "$gracilis" motions "$model" --joint hip_r --combined none --range hip_flexion_r=-10:90 --out "$out/motions"
  mkdir -p "$out/activations"
  for motion in "$out"/motions/*.mot; do
    name=$(basename "$motion" .mot)
    quietly "$out/optimization.txt" "$gracilis" static-optimization --model "$model" --motion "$motion" --every 10 \
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
  quietly "$out/$name.txt" "$gracilis" "$@" --only "$only" "${more[@]}" --metrics light --out "$out/$name" --force
}

if [[ -n $cadaver ]]; then
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
    for view in anterior lateral; do
      quietly "$out/picture_$each.txt" "$gracilis" render "$out/$each" --frames "$frames" --view "$view" --out "$out/${each}_$view.png"
    done
  done
fi
"$gracilis" print-config >"$out/config.toml"
python3 -B "$here/make.py" "$out" "$here"
echo "$out/index.html"
