#!/usr/bin/env bash
# Cylinder musculotendons (Laclé 2014): Tables 3.1 to 3.4 and 5.1 to 5.3, Figures 3.9, 3.15, 3.22 and 5.1 to 5.6, and frames per second, on OpenSim's
# walking model and the leg of Z-Anatomy. A few minutes of one core.
#   reproductions/lacle-2014/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: fewer scales, every 25th frame, no pictures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" lacle-2014 "$@"
model=$data/opensim/subject01_simbody_adjusted_StaticOp.osim
has opensim leg/muscles || exit 0
rays=(6 8 10 12) counted=(0 1 2) cast=(1 2) scalars=(1 2 3 4 5 6) every=1
[[ -z $thin ]] || { rays=(6 12) counted=(0 1) cast=(1) scalars=(1 6) every=25; }
# The 24 lines of each side that the publication takes (its appendix A).
lines=add_mag2,bifemlh,bifemsh,glut_max1,glut_max2,glut_max3,glut_med1,glut_med2,glut_med3,grac,iliacus,gem,med_gas,pect,peri,psoas,quad_fem
lines=$lines,rect_fem,sar,soleus,tfl,tib_ant,tib_post,vas_int
both=$(tr , '\n' <<<"$lines" | sed 's/.*/&_r,&_l/' | paste -sd,)

# into FOLDER [options of import]: a scene of the walking model, half of each tendon's slack length at the insertion, as published.
into() {
  local folder=$1
  shift
  rm -rf "$folder"
  mkdir -p "${folder%/*}"
  quietly "$folder.txt" "$gracilis" import "$model" --tendon half "$@" --out "$folder"
}

# Table 3.3: half a tendon, and in a skeleton that is 0.292/0.303 as large.
ratio=$(awk 'BEGIN { print 0.292 / 0.303 }')
for body in tibia_r talus_r calcn_r; do printf '[bodies.%s]\nscale = [%s, %s, %s]\n' "$body" "$ratio" "$ratio" "$ratio"; done >"$out/smaller.toml"
into "$out/tendon/model" --muscles tib_ant_r
into "$out/tendon/smaller" --muscles tib_ant_r --fit "$out/smaller.toml"

# Table 5.1: 48 muscles in twelve scales, and that of p. 51.
scales=$(for level in "${counted[@]}"; do for count in "${rays[@]}"; do echo "$level $count"; done; done)
while read -r level count; do
  into "$out/counts/${level}_$count" --muscles "$both" --scaling "$level" --rays "$count"
  "$gracilis" inspect --json "$out/counts/${level}_$count/muscles/"*.vtp >"$out/counts/${level}_$count.json"
done <<<"$scales"$'\n'"1 36"

# The leg's surfaces beside the file that names them; Figure 3.15: three slices of each, and of two more, 72 in all.
mkdir -p "$out/leg"
cp -r "$data/leg/muscles" "$data/leg/leg_mended" "$here/surfaces.toml" "$out/leg"
surfaces="$(sed -n 's/.*files = "\([^"]*\)".*/\1/p' "$here/surfaces.toml") muscles/superior_gemellus_r.ply muscles/obturator_internus_r.ply"
(cd "$out/leg" && "$gracilis" inspect --json --slices 3 $surfaces) >"$out/slices.json"

# Tables 5.2 and 5.3: centers outside of the surfaces, by the published heuristic alone; the last also as mended here.
pose=pelvis_tilt=0,pelvis_list=0,pelvis_rotation=-90,pelvis_tx=0,pelvis_ty=0,pelvis_tz=0,hip_flexion_r=0,hip_adduction_r=0,hip_rotation_r=0
pose=$pose,knee_angle_r=0,ankle_angle_r=0,subtalar_angle_r=0,mtp_angle_r=0
fitted=(--pose "$pose" --fit "$here/fit.toml" --muscles "$(sed -n 's/^\([a-z0-9_]*\) = .*/\1/p' "$here/surfaces.toml" | paste -sd,)")
onto=(--surfaces "$out/leg/surfaces.toml")
for level in "${cast[@]}"; do
  for scalar in "${scalars[@]}"; do
    for count in "${rays[@]}"; do
      scale=(--scaling "$level" --more-rays "$scalar" --rays "$count")
      into "$out/outside/${level}_${scalar}_$count" "${fitted[@]}" "${onto[@]}" "${scale[@]}" --centers published
    done
  done
done
into "$out/mended" "${fitted[@]}" "${onto[@]}" --scaling 2 --more-rays 1 --rays 6
# Figure 3.9: the three ways to choose the plane that cuts the surface.
for planes in fixed forward centered; do
  into "$out/planes/$planes" "${fitted[@]}" "${onto[@]}" --scaling 1 --more-rays 6 --rays 12 --centers published --planes "$planes"
done
start=$(date +%s.%N)
into "$out/enhanced36" "${fitted[@]}" "${onto[@]}" --scaling 1 --more-rays 1 --rays 36 --centers published
awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN { print b - a }' >"$out/enhanced36.seconds"

# Frames per second of a walk, without drawing: 48 muscles in two scales, and ten with and without 25 transversals.
geometry=(--geometry "$data/opensim/geometry")
walk=(--motion "$data/opensim/subject01_walk1_Kinematics.sto" --scaling 1)
ten=$(sed -n 's/^muscle = "\(.*\)"/\1/p' "$here/transversals.toml" | sort -u | paste -sd,)
into "$out/walk8" --muscles "$both" "${walk[@]}" --rays 8
into "$out/walk36" --muscles "$both" "${walk[@]}" --rays 36
into "$out/ten" --muscles "$ten" "${walk[@]}" "${geometry[@]}" --rays 8
cp "$here/transversals.toml" "$out/ten"
# frames NAME SCENE
frames() {
  is_finished "$out/run_$1" ||
    quietly "$out/run_$1.txt" "$gracilis" run "$2" --set method=cylinder "${more[@]}" --every "$every" --no-ramp --no-fibers --no-pictures --yes \
      --out "$out/run_$1" --force
}
frames walk8 "$out/walk8/subject01_walk1_Kinematics.toml"
frames walk36 "$out/walk36/subject01_walk1_Kinematics.toml"
frames free "$out/ten/subject01_walk1_Kinematics.toml"
frames yielding "$out/ten/transversals.toml"

# rest NAME SCENE OPTION...: the one frame of a scene that stands still, into OUT/rest.
rest() {
  local folder=$out/rest/$1 scene=$2
  shift 2
  mkdir -p "$out/rest"
  is_finished "$folder" || quietly "$folder.txt" "$gracilis" run "$scene" --set method=cylinder "$@" --no-ramp --no-fibers --metrics none \
    --no-pictures --out "$folder" --force
}

# Figures 5.2 and 5.4: sections and their inner points, and how many vertices they have.
for folder in "$out"/outside/[12]_1_*/; do "$gracilis" inspect --json "$folder"muscles/*.vtp >"${folder%/}.json"; done
rest sections "$out/outside/1_6_12/rest.toml"
cp "$out/outside/1_6_12/model.toml" "$out/rest/sections.toml"
quietly "$out/rest/sections_csv.txt" "$gracilis" export "$out/rest/sections" --to csv --frames 0 --out "$out/rest/sections_csv"

# Figures 5.1 and 5.3 to 5.5.
if [[ -z $thin ]]; then
  for scalar in 3 6; do rest "css${scalar}_gracilis" "$out/outside/2_${scalar}_8/rest.toml" --only grac_r; done
  for level in 1 2; do
    for count in "${rays[@]}"; do rest "lss${level}_$count" "$out/outside/${level}_1_$count/rest.toml" --only sar_r; done
  done
  into "$out/leg_before" "${fitted[@]}" "${geometry[@]}" --scaling 1 --rays 6
  into "$out/leg_after" "${fitted[@]}" "${geometry[@]}" "${onto[@]}" --scaling 1 --more-rays 6 --rays 6 --centers published
  for side in before after; do frames "leg_$side" "$out/leg_$side/rest.toml"; done
  python3 -B "$root/reproductions/family/pictures.py" "$gracilis" "$out" "$here"
fi
python3 -B "$here/make.py" "$out" "$here" "$model" $complete
echo "$out/index.html"
