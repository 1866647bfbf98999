#!/usr/bin/env bash
# Strings of the cadaver's hip calibrated on published moment arms about flexion, and judged by adduction and rotation, which
# they have not seen (docs/guide/calibration.md). Ten minutes on two busy cores; killed, it goes on.
#   reproductions/hip-calibration/run.sh [--data FOLDER] [--out FOLDER]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
data=${GRACILIS_DATA:-$root/../shared/data}
out=$root/out/hip-calibration
while (($#)); do
  case $1 in
    --data) data=$2; shift ;;
    --out) out=$2; shift ;;
    *)
      echo "usage: run.sh [--data FOLDER] [--out FOLDER]" >&2
      exit 2
      ;;
  esac
  shift
done
[[ -d $data/validation ]] || {
  echo "skipped: there is no $data/validation" >&2
  exit 0
}
mkdir -p "$out"
cp "$here/targets.toml" "$out/targets.toml"
# cm over flexion, rotation at 0: a curve of one point for each pose
awk -F, 'BEGIN { print "muscle,coordinate,source,angle_deg,moment_arm_cm" }
  $1 == 0 || $1 == 30 || $1 == 60 { print "gluteus_medius_r,hip_rotation_r,flexion " $1 ",0," $4 }' \
  "$data/validation/Dostal1986.csv" >"$out/dostal_rotation.csv"
"${GRACILIS:-$root/build/release/bin/gracilis}" calibrate "$root/scenes/lhdl_hip/hip.toml" --data "$data" \
  --targets "$out/targets.toml" --set method=strings --out "$out/calibrated"
