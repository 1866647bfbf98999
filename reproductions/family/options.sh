# What the reproductions' scripts share: sourced with their own name and options.
#   source family/options.sh NAME "$@"
# Sets root, here, data, out, thin (empty, or --thin), gracilis, and more (what is left of the options). What OUT has from a pass with
# other options, data or another version goes.
name=$1
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../$name" && pwd)
root=$(cd "$here/../.." && pwd)
data=${GRACILIS_DATA:-$root/../shared/data}
out=$root/out/$name
gracilis=${GRACILIS:-$root/build/release/bin/gracilis}
thin=
more=()
while (($#)); do
  case $1 in
    --data) data=$2; shift ;;
    --out) out=$2; shift ;;
    --thin) thin=--thin ;;
    --methods) more+=(--words "method=$2"); shift ;;
    --set) more+=(--set "$2"); shift ;;
    *)
      echo "usage: reproductions/$name/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]" >&2
      exit 2
      ;;
  esac
  shift
done
source "$root/reproductions/family/stamp.sh"
begin_in "$out" "$gracilis" "${thin:-full}" --data "$data" "${more[@]}"

# has FOLDER...: whether the data have all of these. Where not, that is told.
has() {
  local each
  for each; do
    [[ -d $data/$each ]] || {
      echo "skipped: there is no $data/$each" >&2
      return 1
    }
  done
}

# reproduce: what HERE/steps.toml and HERE/pictures.toml list, and the page.
reproduce() {
  python3 -B "$root/reproductions/family/reproduce.py" "$gracilis" "$here" "$out" "$data" $thin "${more[@]}"
}
