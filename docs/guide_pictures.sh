#!/usr/bin/env bash
# Makes the pictures of the guide's pages: a drafted scene, its run, an active muscle, and what goes wrong beside its cure.
# All from the built-in hip and elbow; files in out/guide.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

gracilis=$(realpath "${GRACILIS:-build/release/bin/gracilis}")
pictures=$PWD/docs/pictures
mkdir -p out/guide/scans
cd out/guide

smaller() { # FILE PICTURE WIDTH
  local width height
  read -r width height < <(od -An -tu4 --endian=big -j16 -N8 "$1")  # as its header says
  echo "<body style='margin:0'><img src='$1' width=$3>" >smaller.html
  chromium --headless=new --no-sandbox --hide-scrollbars "--window-size=$3,$((($3 * height + width - 1) / width))" \
    "--screenshot=$pictures/$2.png" "file://$PWD/smaller.html" 2>/dev/null
}

# The surfaces that the pages take as if they were one's own.
$gracilis demo --out demo --flexion 0 --set method=skinning --force
for name in hip_bone_r femur_r adductor_longus_r; do
  cp demo/frames/${name}_0000.vtp scans/$name.vtp
done
$gracilis scene scans --out my_hip.toml --force
smaller my_hip.png first_scene 720
$gracilis run my_hip.toml --out first --force
smaller first/preview.png first_run 1000

# A scene of the muscle, by what holds its insertion (and its activation), abducted to an angle.
scene() { # NAME INSERTION DEGREES [MORE]
  cat >"$1.toml" <<TOML
schema = 1
[[bones]]
name = "hip_bone_r"
body = "pelvis"
file = "scans/hip_bone_r.vtp"
[[bones]]
name = "femur_r"
file = "scans/femur_r.vtp"
[[joints]]
name = "hip_r"
parent = "pelvis"
child = "femur_r"
center = [0, 0, 0]
[[joints.axes]]
coordinate = "hip_adduction_r"
axis = [1, 0, 0]
[[muscles]]
name = "adductor_longus_r"
file = "scans/adductor_longus_r.vtp"
[[muscles.attachments]]
name = "pubis"
end = "origin"
bone = "hip_bone_r"
bone_distance_mm = 5
[[muscles.attachments]]
name = "linea_aspera"
end = "insertion"
$2
[motion]
coordinates = ["hip_adduction_r"]
key_poses_deg = [[0], [$3]]
${4:-}
TOML
  $gracilis run "$1.toml" --out "$1" --force --strict
}
beside() { # PICTURE RUN RUN_B FRAME MORE...
  $gracilis render "$2" --compare "$3" --out "$pictures/$1.png" --size 1000x520 --frames "$4" --view "$5" "${@:6}"
}

near='bone = "femur_r"
bone_distance_mm = 5'
scene held "$near" -30
scene handful 'body = "femur_r"
vertices = [786, 794, 812, 839]' -30
beside wrong_handful handful held 30 anterior --focus adductor_longus_r --color-by edge-stretch
scene too_much 'bone = "femur_r"
bone_distance_mm = 40' -30
beside wrong_stretch too_much held 30 anterior --focus adductor_longus_r --color-by edge-stretch

scene active "$near" 0 '[sequence]
hold_frames = 20
[[activations]]
muscle = "adductor_longus_r"
value = 0.8'
scene relaxed "$near" 0 '[sequence]
hold_frames = 20'
beside active relaxed active 20 anterior --focus adductor_longus_r --color-by activation

$gracilis demo --out by_skinning --set method=skinning --only gluteus_maximus_r --force
$gracilis demo --out by_xpbd --only gluteus_maximus_r --force --strict  # what cures meets every gate
beside wrong_volume by_skinning by_xpbd 90 posterolateral --color-by volume
$gracilis demo elbow --out elbow_by_skinning --set method=skinning --force
$gracilis demo elbow --out elbow_by_xpbd --force --strict
beside wrong_place elbow_by_skinning elbow_by_xpbd 65 lateral

for picture in first_scene first_run active wrong_handful wrong_stretch wrong_volume wrong_place; do
  echo "docs/pictures/$picture.png: $(($(stat --format=%s "$pictures/$picture.png") / 1024)) KiB"
done
