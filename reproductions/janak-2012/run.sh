#!/usr/bin/env bash
# Mass-spring systems (Janák 2012): Figures 5.2 to 5.18 and Tables 5.1 to 5.3, on the cadaver's hip, turned from the scan's pose to 60 degrees
# of flexion at once, and on the thigh of OpenSim's walking model, thirteen muscles as published, taken from its default pose to those of a
# walk at once. Half an hour of one core.
#   reproductions/janak-2012/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: two layouts, 100 iterations at most, two muscles of the
# thigh, no pictures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" janak-2012 "$@"
has lhdl-hip || exit 0
reproduce
