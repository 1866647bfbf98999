#!/usr/bin/env bash
# Extended position based dynamics (Havlíček 2024): Tables 6.1 and B.1, fiber lengths as in Figures 7.10 and 7.11 of XPBD with 70 iterations,
# passive and active, and PBD with 3, Figures 4.1, 6.1 to 6.6, 7.1 to 7.9 and A.1 to A.14, and a sweep of step sizes for explosions (section
# 6.6.2). On the cadaver's hip, whose activations static optimization finds for poses all over its joint's range, and a leg of 26 muscles;
# without the data, on the built-in hip with an active iliacus, and without the motions by the joint control unit.
# Half an hour of one core.
#   reproductions/havlicek-2024/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: two muscles, 10 degrees of the built-in hip and of
# each of the cadaver's motions, no pictures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" havlicek-2024 "$@"
steps=(10 5 2 0.5) flexion=90 cadaver=yes only=gluteus_maximus_r,gluteus_medius_r,iliacus_r,adductor_brevis_r # section 7.1
every=10 step=1
declare -A farthest=([flexion]=90,0,0 [extension]=-40,0,0 [abduction]=0,-45,0 [rotation]=0,0,60) # Figures 7.1 and 7.4 to 7.6
[[ -z $thin ]] || {
  steps=(5) flexion=10 only=gluteus_maximus_r,iliacus_r every=60 step=5
  farthest=([flexion]=10,0,0 [extension]=-10,0,0 [abduction]=0,-10,0 [rotation]=0,0,10)
}
model=$data/opensim/subject01_simbody_adjusted_StaticOp.osim
has_data=
! has lhdl-hip opensim || has_data=yes
[[ -z $thin && -n $has_data ]] || cadaver=

# Samples for the hip's joint control unit (section 6.5.1): motions through its range, and their activations by static optimization.
sample_activations() {
  local motion name
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
  quietly "$out/$name.txt" "$gracilis" "$@" "${more[@]}" --metrics light --no-pictures --out "$out/$name" --force
}

# controlled MOTION PRESET: the cadaver's muscles driven by the joint control unit, into OUT/controlled, and which samples it asks.
controlled() {
  local folder=$out/controlled/$1_$2
  mkdir -p "$out/controlled"
  is_finished "$folder" || quietly "$folder.txt" "$gracilis" run "$out/active.toml" --data "$data" --set "preset=$2" --set "motion.step_deg=$step" \
    --set "motion.key_poses_deg=[[0,0,0],[${farthest[$1]}]]" --only "$only" "${more[@]}" --metrics light --no-pictures --out "$folder" --force
  quietly "$folder.neighbors.txt" "$gracilis" activations neighbors "$out/samples.sto" "$folder" --out "$out/neighbors/$1"
}

# controlled_scene FILE INCLUDED SAMPLES MORE: a scene whose hip has a joint control unit.
controlled_scene() {
  printf 'schema = 1\nname = "havlicek_2024_%s"\ninclude = "%s"\n%s[[joint_control_units]]\nname = "hip_r"\njoint = "hip_r"\nsamples = "%s"\n' \
    "$(basename "$1" .toml)" "$2" "${4:-}" "$3" >"$1"
}

# leg NAME SCENE DEGREES OPTION...: muscles of the shared leg, active, hip flexion by 1 degree a frame (section 7.2).
leg() {
  local name=$1 scene=$out/$2.toml degrees=$3
  is_finished "$out/$name" && return
  shift 3
  quietly "$out/$name.txt" "$gracilis" run "$scene" --data "$data/leg" --set preset=thesis-2024 \
    --set "motion.key_poses_deg=[[0,0],[$degrees,0]]" "$@" "${more[@]}" --no-fibers --metrics light --no-pictures --out "$out/$name" --force
}

# Section 7.2: 26 muscles with both stiffnesses for three degrees, then those that do not explode at once to 90.
many_muscles() {
  local proximal=adductor_longus_r,adductor_minimus_r,biceps_femoris_long_r,biceps_femoris_short_r,gluteus_maximus_r,gluteus_medius_r
  proximal=$proximal,gluteus_minimus_r,iliacus_r,inferior_gemellus_r,obturator_externus_r,obturator_internus_r,pectineus_r,piriformis_r
  proximal=$proximal,psoas_major_r,quadratus_femoris_r,rectus_femoris_r,superior_gemellus_r
  local distal=adductor_brevis_r,gracilis_r,sartorius_r,semimembranosus_r,semitendinosus_r,vastus_intermedius_r,vastus_lateralis_r,vastus_medialis_r
  quietly "$out/leg_samples.txt" "$gracilis" activations join "$out/motions" "$out/activations" --map "$here/leg_names.toml" --out "$out/leg_samples.sto"
  controlled_scene "$out/leg.toml" "$data/leg/leg.toml" "$out/leg_samples.sto" \
    $'[motion]\ncoordinates = ["hip_flexion_r", "knee_flexion_r"]\nkey_poses_deg = [[0, 0], [90, 0]]\nstep_deg = 1\n'
  printf 'schema = 1\nname = "few"\ninclude = "leg.toml"\n[[muscles]]\nname = "psoas_major_r"\n[muscles.fibers]\ncount = 16\n' >"$out/leg_few.toml"
  leg leg_all_100 leg 3
  leg leg_all_1e5 leg 3 --set distance_stiffness=1e5
  leg leg_published leg_few 90 --only "$proximal"
  leg leg_stiff leg 90 --only "$proximal,$distal" --set distance_stiffness=1e5
}

# Figure 6.6: the walking model in the motion that static optimization was asked about, from 40 degrees of extension on.
extended() {
  is_finished "$out/extended" && return
  local motion=$out/motions/hip_r_hip_flexion_r.mot scene=$out/extension muscles
  quietly "$scene.txt" "$gracilis" import "$model" --geometry "$data/opensim/geometry" --motion "$motion" --out "$scene"
  muscles=$(sed -n 's/^name = "\(.*_r\)"$/\1/p' "$scene/model.toml" | grep -Fxf <(sed -n '/^time/{s/\t/\n/gp;q}' "$out/activations/hip_r_hip_flexion_r.sto") | sort -u)
  {
    printf 'schema = 1\nname = "extended"\ninclude = "hip_r_hip_flexion_r.toml"\n[[activations]]\nmuscle = ['
    printf '"%s", ' $muscles
    printf ']\nfile = "%s"\n' "$out/activations/hip_r_hip_flexion_r.sto"
  } >"$scene/active.toml"
  quietly "$out/extended.txt" "$gracilis" run "$scene/active.toml" --set method=cylinder --every 30 --no-ramp --no-fibers --metrics none --no-pictures \
    --out "$out/extended" --force
}

if [[ -n $has_data ]]; then
  sample_activations
  controlled_scene "$out/active.toml" "$here/hip.toml" "$out/samples.sto"
  for motion in flexion extension abduction rotation; do
    for preset in thesis-2024 physical; do
      [[ -n $thin && $preset == physical ]] || controlled "$motion" "$preset"
    done
  done
fi
hip passive thesis-2024 passive 1 --only "$only"
hip active thesis-2024 active 1 --only "$only"
hip pbd pbd-2020 passive 1 --only "$only"
alone=passive
[[ -z $cadaver ]] || alone=active
hip corrections thesis-2024 "$alone" 1 --only gluteus_maximus_r --no-fibers --corrections
[[ -d $out/corrections_csv ]] || quietly "$out/corrections_csv.txt" "$gracilis" export "$out/corrections" --to csv --out "$out/corrections_csv"
for kind in passive active; do
  for step in "${steps[@]}"; do hip "sweep/${kind}_$step" thesis-2024 "$kind" "$step" --only "$only" --no-fibers; done
done
if [[ -n $cadaver ]]; then
  published=(fibers "$out/active.toml" --data "$data" --set preset=thesis-2024)
  "$gracilis" "${published[@]}" --only "$only" --json --out "$out/fibers" 2>"$out/fibers.txt" >"$out/fibers.json"
  quietly "$out/few_fibers.txt" "$gracilis" "${published[@]}" --only iliacus_r --set fibers.count=16 --set contraction.segments=15 --out "$out/few_fibers"
  extended
  ! has leg || many_muscles
fi
[[ -n $thin ]] || python3 -B "$root/reproductions/family/pictures.py" "$gracilis" "$out" "$here"
"$gracilis" print-config >"$out/config.toml"
python3 -B "$here/make.py" "$out" "$here" $complete
echo "$out/index.html"
