#!/usr/bin/env bash
# Radial basis functions for muscles (Červenka 2024): Tables 3.1 and 3.2, Figures 5.1 to 5.8, 5.11 and 5.13, and what its model of a muscle
# makes of a flexed hip. The built-in hip needs no data; with them gluteus maximus and attachments of the cadaver. Three minutes of one core.
#   reproductions/cervenka-2024/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours), OUT/tables and OUT/figures. --thin: few functions, two muscles and 10 degrees.
# Its tables are gracilis_rbf_tables', which stands beside gracilis; where it is missing in a build folder it is built.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" cervenka-2024 "$@"
programs=$(cd "$(dirname "$gracilis")" && pwd)
if [[ ! -x $programs/gracilis_rbf_tables && -f $programs/../CMakeCache.txt ]]; then
  cmake --build "$programs/.." --target gracilis_rbf_tables >&2
fi
[[ -x $programs/gracilis_rbf_tables ]] || {
  echo "there is no $programs/gracilis_rbf_tables (cmake --build --preset release --target gracilis_rbf_tables builds one)" >&2
  exit 1
}
reproduce
