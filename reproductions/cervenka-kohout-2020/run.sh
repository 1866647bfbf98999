#!/usr/bin/env bash
# What Cervenka and Kohout (2020) showed of position based dynamics: 1 rad of hip flexion in 100 frames, back in 100, 100 of rest, for
# four muscles of the cadaver, and a box squeezed between two plates; Figures 1 to 21 and Table 1. Three minutes of processor time.
#   reproductions/cervenka-kohout-2020/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: the box alone.
# Exit code 1: the page lacks something, a muscle's volume was off by 1 % or more, or the box did not come back.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" cervenka-kohout-2020 "$@"
reproduce
