#!/usr/bin/env bash
# Cylinder musculotendons (Laclé 2014): Tables 3.1 to 3.4 and 5.1 to 5.3, Figures 3.9, 3.15, 3.22 and 5.1 to 5.6, and frames per second, on OpenSim's
# walking model and the leg of Z-Anatomy. A few minutes of one core.
#   reproductions/lacle-2014/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: fewer scales, every 25th frame, no pictures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" lacle-2014 "$@"
has opensim leg/muscles || exit 0
reproduce
