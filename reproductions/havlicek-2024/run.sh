#!/usr/bin/env bash
# Extended position based dynamics (Havlíček 2024): Tables 6.1 and B.1, fiber lengths as in Figures 7.10 and 7.11 of XPBD with 70 iterations,
# passive and active, and PBD with 3, Figures 4.1, 6.1 to 6.6, 7.1 to 7.9 and A.1 to A.14, and a sweep of step sizes for explosions (section
# 6.6.2). On the cadaver's hip, whose activations static optimization finds for poses all over its joint's range, and a leg of 26 muscles;
# without the data, on the built-in hip with an active iliacus, and without the motions by the joint control unit.
# Half an hour of one core.
#   reproductions/havlicek-2024/run.sh [--thin] [--data FOLDER] [--out FOLDER] [--set KEY=VALUE ...]
# Leaves OUT/index.html, OUT/results.csv (published beside ours) and OUT/figures. --thin: two muscles, 10 degrees of the built-in hip and of
# each of the cadaver's motions, no pictures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../family/options.sh" havlicek-2024 "$@"
reproduce
