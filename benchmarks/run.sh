#!/usr/bin/env bash
# Times the solver on this machine and writes docs/performance.md. Needs a build (./demo.sh or cmake) with the targets
# gracilis_growth_chart for its charts and gracilis_peer_bullet for the peer, and, for the cadaver's hip, its data. Close
# everything else first: other programs show in the numbers.
set -euo pipefail
cd "$(dirname "$0")/.."
program=${GRACILIS_PROGRAM:-build/release/bin/gracilis}
page=docs/performance.md
four=gluteus_maximus_r,gluteus_medius_r,iliacus_r,psoas_major_r
hip=(scenes/lhdl_hip/flexion.toml --set fibers.count=0 --set sequence.ramp_frames=0)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

say() { printf '%s\n' "$@" >>"$work/page"; }

# Draws the two columns given of a table of rows in a file as docs/pictures/NAME.svg and shows it.
draw_growth() {
  local name=$1 what=$2 size=$3 ms=$4 file=$5 chart
  chart=$(dirname "$program")/gracilis_growth_chart
  [ -x "$chart" ] || return 0
  awk -F'|' -v s="$size" -v m="$ms" '{ print $(s + 1), $(m + 1) }' "$file" |
    "$chart" "docs/pictures/$name.svg" "Growth with $what" "$what"
  say "" "![Growth with $what](pictures/$name.svg)"
}

# Lines of `gracilis bench` of one phase as rows: muscle, triangles, threads, ms, hash.
rows() { awk -v phase="$1" '$2 == phase { printf "| %s | %s | %s | %s | `%s` |\n", $1, $4, $3, $5, $6 }' "$2"; }

machine() {
  local processor
  processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
  printf '%s, %s threads, %s; %s' "$processor" "$(nproc)" "$("$program" --version)" "$(uname -sr)"
}

say "# Performance" "" "Written by \`benchmarks/run.sh\` on: $(machine)." ""
say "Times are medians in milliseconds of wall clock; the fingerprint of the resulting state stands beside each. On another" \
  "machine, or with other programs running, they differ; ratios within one table say more than numbers." ""

"$program" bench "${hip[@]}" --only "$four" --frame 45 >"$work/four"
say "## One iteration" "" "Every kind of constraint once, bones included, at 45 degrees of flexion of the cadaver's hip." "" \
  "| muscle | triangles | threads | ms | state |" "| --- | --- | --- | --- | --- |"
rows iteration "$work/four" >>"$work/page"
say "" "By kind of constraint, one thread:" "" "| muscle | distance | dihedral | volume | stretch limit | bone contact |" \
  "| --- | --- | --- | --- | --- | --- |"
awk '$3 == 1 && $1 != "all" { ms[$1, $2] = $5; if ($2 == "iteration") names[++n] = $1 }
  END { for (i = 1; i <= n; ++i) { m = names[i]
    printf "| %s | %s | %s | %s | %s | %s |\n", m, ms[m, "distance"], ms[m, "dihedral"], ms[m, "volume"], ms[m, "stretch_limit"], ms[m, "bone_contact"] } }' \
  "$work/four" >>"$work/page"

say "" "## Whole frames" "" "The four muscles, one degree of flexion per frame, by iterations and by \`contact.muscle\`." "" \
  "| iterations | contact | threads | ms | frames per second |" "| --- | --- | --- | --- | --- |"
for iterations in 30 70; do
  for contact in none virtual-edges surface; do
    "$program" bench "${hip[@]}" --only "$four" --frame 45 --repeats 1 --set iterations="$iterations" \
      --set contact.muscle="$contact" >"$work/frames"
    awk -v i="$iterations" -v c="$contact" '$2 == "frame" { printf "| %s | %s | %s | %s | %.1f |\n", i, c, $3, $5, 1000 / $5 }' \
      "$work/frames" >>"$work/page"
  done
done

say "" "## Gluteus maximus alone" "" "70 iterations per frame, one degree of flexion per frame." "" \
  "| threads | ms | frames per second |" "| --- | --- | --- |"
"$program" bench "${hip[@]}" --only gluteus_maximus_r --frame 45 --repeats 1 --set iterations=70 |
  awk '$2 == "frame" { printf "| %s | %s | %.1f |\n", $3, $5, 1000 / $5 }' >>"$work/page"

study=gluteus_maximus_r,gluteus_medius_r,iliacus_r,adductor_brevis_r
say "" "## The published study's four muscles, and the preset \`fast\`" "" \
  "61,354 triangles, one degree of flexion per frame, contact of all kinds; errors of \`fast\`: docs/convergence.md." "" \
  "| setting | threads | ms | frames per second | state |" "| --- | --- | --- | --- | --- |"
for setting in iterations=70 preset=physical preset=fast; do
  "$program" bench "${hip[@]}" --only "$study" --frame 45 --repeats 1 --set "$setting" |
    awk -v s="$setting" '$2 == "frame" { printf "| %s | %s | %s | %.1f | `%s` |\n", s, $3, $5, 1000 / $5, $6 }' >>"$work/page"
done

say "" "## Tissue" "" "\`method = \"tissue\"\`: the four muscles, one degree of flexion per frame, mean of the second half of 45 frames. 8 iterations are for" \
  "a live picture; after 30, the default, mean fiber lengths are within 0.04 mm of those after 400; the last rows stop by the residual, 1e-5 N." "" \
  "| iterations at most | muscles meet | threads | ms | frames per second | state |" "| --- | --- | --- | --- | --- | --- |"
for iterations in 8 30 "400 --set minimizer_residual=1e-5"; do
  for contact_rounds in 0 2; do
    # shellcheck disable=SC2086  # the last has an option more
    "$program" bench "${hip[@]}" --only "$four" --frame 45 --repeats 1 --set method=tissue --set contact_rounds=$contact_rounds \
      --set minimizer_iterations=$iterations |
      awk -v i="${iterations%% *}" -v c="$contact_rounds" '$2 == "frame" {
        printf "| %s | %s | %s | %s | %.1f | `%s` |\n", i, (c > 0 ? "yes" : "no"), $3, $5, 1000 / $5, $6 }' >>"$work/page"
  done
done

say "" "Gluteus maximus by the size of its cells, 8 iterations, one thread; median of 30 frames." "" \
  "| cells | edge, mm | ms per frame | µs per cell |" "| --- | --- | --- | --- |"
for size in 0.016 0.012 0.008 0.006 0.005 0.004; do
  # A missed gate (exit code 5) is no reason to stop.
  "$program" rom scenes/lhdl_hip/hip.toml --coord hip_flexion_r=0:30:1 --only gluteus_maximus_r --set fibers.count=2 \
    --set method=tissue --set cell_size=$size --set cells_at_least=0 --set minimizer_iterations=8 --threads 1 \
    --out "$work/cells_$size" >"$work/cells.txt" 2>&1 || [ $? -eq 5 ]
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $at["hip_flexion_r_deg"] > 0.5 { print $at["milliseconds"], $at["cells"] }' "$work/cells_$size/measures.csv" | sort -n |
    awk -v s="$size" '{ ms[NR] = $1; cells = $2 }
      END { m = ms[int((NR + 1) / 2)]; printf "| %d | %g | %.2f | %.2f |\n", cells, 1000 * s, m, 1000 * m / cells }' >>"$work/cells"
done
cat "$work/cells" >>"$work/page"

say "" "## Files to first frame" "" "The study's four muscles, from reading the scene to the first solved frame, all threads: with an empty" \
  "cache of distance fields, and with a full one; medians of three looks." "" "| cache | seconds |" "| --- | --- |"
for cache in empty full; do
  for _ in 1 2 3; do
    if [ "$cache" = empty ]; then rm -rf "$work/cache"; fi
    XDG_CACHE_HOME="$work/cache" "$program" bench "${hip[@]}" --only "$study" --frame 1 --repeats 1 |
      awk '$2 == "first_frame" { print $5 / 1000 }'
  done | sort -n | awk -v c="$cache" 'NR == 2 { printf "| %s | %.2f |\n", c, $1 }' >>"$work/page"
done

say "" "## Growth with muscles" "" "Copies of the built-in hip's muscles, each for itself, all threads." "" \
  "| muscles | triangles | ms per frame | ms per frame and muscle |" "| --- | --- | --- | --- |"
for count in 1 2 4 8 16 32 64; do
  "$program" bench --muscles "$count" --frame 5 --threads "$(nproc)" |
    awk -v n="$count" '$2 == "frame" { printf "| %s | %s | %.2f | %.3f |\n", n, $4, $5, $5 / n }' >>"$work/muscles"
done
cat "$work/muscles" >>"$work/page"
draw_growth growth_with_muscles muscles 1 3 "$work/muscles"

peer=$(dirname "$program")/gracilis_peer_bullet
if [ -x "$peer" ]; then
  say "" "## A peer on the same meshes" "" "One sweep over all edges, one thread: our distance constraints beside the links of Bullet's soft bodies" \
    "(Debian's libbullet-dev), taking turns, from the same positions, masses and target lengths. Bullet's links have no compliance" \
    "and it has no constraint like our others. Errors: root mean square of the edges' relative error, before and after 10 sweeps." "" \
    "| muscle | triangles | ms, ours | ms, Bullet | ratio | error before | after ours | after Bullet | state, ours | state, Bullet |" \
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  "$peer" >>"$work/page"
fi

say "" "## Growth with triangles" "" "Gluteus maximus, two coarser copies, itself, and each triangle divided into four again and again (the last: of the second copy); one thread. The last column is" \
  "what preparing and solving the muscle took beyond what the process held before, at its peak." "" \
  "| triangles | ms per iteration | ns per triangle | bytes per triangle |" "| --- | --- | --- | --- |"
for size in "--coarsen 0.0086" "--coarsen 0.0045" "--subdivide 0" "--subdivide 1" "--subdivide 2" "--subdivide 3" "--coarsen 0.0045 --subdivide 4"; do
  # shellcheck disable=SC2086  # an option and its value
  "$program" bench "${hip[@]}" --only gluteus_maximus_r --frame 5 --threads 1 --repeats 15 $size --json |
    awk -F'[:,]' '/"triangles"/ { t = $2 } /"ms"/ { ms = $2 }
      /peak_bytes/ { printf "| %d | %.3f | %.1f | %d |\n", t, ms, 1e6 * ms / t, $2 }' >>"$work/triangles"
done
cat "$work/triangles" >>"$work/page"
draw_growth growth_with_triangles triangles 1 2 "$work/triangles"

mv "$work/page" "$page"
echo "$page"
