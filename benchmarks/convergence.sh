#!/usr/bin/env bash
# Measures how near to the converged shape the solver comes in how much time and writes docs/convergence.md with a chart
# per muscle. Needs the targets gracilis_convergence and gracilis_end_shapes and, for the cadaver's hip, its data.
set -euo pipefail
cd "$(dirname "$0")/.."
programs=${GRACILIS_PROGRAMS:-build/release/bin}
page=docs/convergence.md
study=gluteus_maximus_r,gluteus_medius_r,iliacus_r,adductor_brevis_r
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
say() { printf '%s\n' "$@" >>"$work/page"; }

processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
say "# Convergence" "" "Written by \`benchmarks/convergence.sh\` on: $processor; what follows from it:" \
  "[decision 0003](decisions/0003-coarser-copies-before-more-iterations.md). Times are processor times, which other programs" \
  "disturb less than wall clock, but do disturb; ratios within one table say more than numbers." "" "## One frame" "" \
  "One degree of flexion, from 44 to 45, each muscle alone with the bones, one thread. Error: mean distance of the vertices" \
  "from the same step after 3000 plain iterations. \`whole frame\` is the method as users have it, prediction and listing of" \
  "contacts included; the others are iterations alone. For small steps the count is that of substeps with one iteration each." ""
"$programs/gracilis_convergence" docs/pictures >"$work/table"
for muscle in $(cut -d' ' -f2 "$work/table" | uniq); do say "![$muscle](pictures/convergence_$muscle.svg)" ""; done
say "| muscle | way | count | ms | mean error, mm | state |" "| --- | --- | --- | --- | --- | --- |"
cat "$work/table" >>"$work/page"

say "" "## A whole motion" "" "The published study's four muscles (61,354 triangles) through the first 45 frames of flexion with all contact:" \
  "distance of every vertex from where the default takes it, in mm; dihedrals: turned by more than 90 degrees; ms of all threads together." "" \
  "| setting | muscle | triangles simulated | ms per frame | mean | 99 % | most | volume | deepest in bone, mm | dihedrals | longest edge |" \
  "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
"$programs/gracilis_end_shapes" scenes/lhdl_hip/flexion.toml --set fibers.count=0 --only "$study" --frames 45 - iterations=70 iterations=4 \
  'iterations=1;substeps=8' preset=fast 'preset=fast;simulated_edge=0.004' |
  awk -F, 'NR > 1 { printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", ($1 == "-" ? "default" : $1), $2, $3, $4, $5, $6, $7, $8, $9, $11, $12 }' \
    >>"$work/page"
mv "$work/page" "$page"
echo "$page"
