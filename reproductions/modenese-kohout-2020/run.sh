#!/usr/bin/env bash
# Moment arms by every method beside every published and measured curve: the cadaver's hip (Modenese and Kohout 2020, and what they
# compare with), the shared elbow and knee. Half an hour to an hour for all methods on two cores.
#   reproductions/modenese-kohout-2020/run.sh [--methods M,...] [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours), OUT/table.csv (a row per method and curve: RMS, largest error, coverage of the finite
# elements' band, largest step) and OUT/figures. --thin: the hip alone, in steps of 10 degrees.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" modenese-kohout-2020 "$@"
has validation lhdl-hip || exit 0
reproduce
