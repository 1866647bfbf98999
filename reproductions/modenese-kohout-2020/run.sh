#!/usr/bin/env bash
# Moment arms by every method beside every published and measured curve: the cadaver's hip (Modenese and Kohout 2020, and what they
# compare with), the shared elbow and knee. Half an hour to an hour for all methods on two cores.
#   reproductions/modenese-kohout-2020/run.sh [--methods M,...] [--thin] [--data FOLDER] [--out FOLDER]
# Leaves OUT/table.csv (a row per method and curve: RMS, largest error, coverage of the finite elements' band, largest step) and
# OUT/index.html, the same with charts. Exit code 1: a method has no arms where others have. --thin: the hip alone, in steps of 10 degrees.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
methods=strings,xpbd,tissue,skinning,pbd,arap,rbf,mass-spring,cylinder
data=${GRACILIS_DATA:-$root/../shared/data}
out=$root/out/modenese-kohout-2020
thin=() complete=--complete
while (($#)); do
  case $1 in
    --methods) methods=$2; shift ;;
    --data) data=$2; shift ;;
    --out) out=$2; shift ;;
    --thin) thin=(--step 10 --joints hip) complete= ;;
    *)
      echo "usage: run.sh [--methods M,...] [--thin] [--data FOLDER] [--out FOLDER]" >&2
      exit 2
      ;;
  esac
  shift
done
gracilis=${GRACILIS:-$root/build/release/bin/gracilis}
[[ -d $data/validation ]] || {
  echo "skipped: there is no $data/validation" >&2
  exit 0
}
source "$root/reproductions/family/stamp.sh"
begin_in "$out" "$gracilis" "${thin[*]:-full}" --data "$data"
"$root/reproductions/moment_arms/run.sh" --methods "$methods" --data "$data" --out "$out/sweeps" "${thin[@]}" >/dev/null

# Arms about one coordinate while another is changed: short sweeps about 0 (Dostal 1986).
short() {
  local method=$1 coordinate=$2 flexion=$3 other=$4
  local folder=$out/sweeps/$method/${coordinate}_at_$flexion
  is_finished "$folder" && [[ -f $folder/moment_arms.sto ]] && return
  mkdir -p "${folder%/*}"
  "$gracilis" rom "$root/scenes/lhdl_hip/hip.toml" --data "$data" --coord "$coordinate=-4:4:2" --coord "hip_flexion_r=$flexion" \
    --coord "$other=0" --set method="$method" --out "$folder" --force >"$folder.txt" 2>&1 ||
    [[ -f $folder/moment_arms.sto ]] || echo "$method, $coordinate at $flexion: failed, see $folder.txt" >&2
}
if ((${#thin[@]} == 0)); then
  for method in ${methods//,/ }; do
    for flexion in 0 30 60; do
      short "$method" hip_adduction_r "$flexion" hip_rotation_r
      short "$method" hip_rotation_r "$flexion" hip_adduction_r
    done
  done
fi
# shellcheck disable=SC2086  # a word per method
python3 -B "$here/compare.py" "$data/validation" "$out/sweeps" "$out" ${methods//,/ } $complete
echo "$out/table.csv"
echo "$out/index.html"
