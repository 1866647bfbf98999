#!/usr/bin/env bash
# The tissue's energy against closed forms, and against GetFEM (Debian: python3-getfem) on the same mesh; one core, a minute.
#   reproductions/tissue_verification/run.sh [--quadratic] [--out FOLDER]
# Leaves OUT/closed_forms.md, OUT/cases/ (what the peer reads) and OUT/peer.md. --quadratic: the peer also solves by quadratic
# tetrahedra, which tells what linear ones lack; much longer.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
out=$root/out/tissue_verification
options=()
while (($#)); do
  case $1 in
    --quadratic) options+=(--quadratic) ;;
    --out)
      out=$2
      shift
      ;;
    *)
      echo "usage: run.sh [--quadratic] [--out FOLDER]" >&2
      exit 2
      ;;
  esac
  shift
done
study=${GRACILIS_TISSUE_STUDY:-$root/build/release/bin/gracilis_tissue_study}
python=${PYTHON:-/usr/bin/python3} # Debian's, which finds Debian's getfem
[[ -x $study ]] || {
  echo "there is no $study: cmake --build --preset release --target gracilis_tissue_study" >&2
  exit 1
}
one_core=()
command -v taskset >/dev/null && one_core=(taskset -c 0)
mkdir -p "$out"

"${one_core[@]}" "$study" | tee "$out/closed_forms.md"
"$python" -c 'import getfem' 2>/dev/null || {
  echo "skipped: no getfem for $python (Debian package python3-getfem)" >&2
  exit 0
}
"${one_core[@]}" "$study" --export "$out/cases"
"${one_core[@]}" "$python" "$here/peer.py" "$out/cases" "${options[@]}" | tee "$out/peer.md"
