#!/usr/bin/env bash
# Makes every picture in docs/pictures, all from the built-in hip and elbow: the previews of ./demo.sh in both settings, as they
# are, what `gracilis render` and `gracilis report` make of those runs, and what `gracilis view` shows.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

./demo.sh
gracilis=build/release/bin/gracilis
$gracilis demo --preset thesis-2024 --out out/demo_thesis_2024 --force
pictures=docs/pictures
mkdir -p $pictures
cp out/demo/preview.png $pictures/demo.png
cp out/demo_thesis_2024/preview.png $pictures/demo_thesis_2024.png
$gracilis demo elbow --out out/elbow --force
$gracilis render out/elbow --out $pictures/elbow.png --size 1200x640 --frames 0,33,65

$gracilis render out/demo --out $pictures/flexion.gif --size 420x480 --step 2 --rate 20 --view posterolateral
$gracilis render out/demo --out $pictures/fibers.png --size 1200x560 --view posterolateral --color-by fiber-strain
$gracilis render out/demo --compare out/demo_thesis_2024 --out $pictures/stretch.png --size 1000x560 --frames 90 \
  --view posterolateral --color-by edge-stretch

$gracilis report out/demo out/demo_thesis_2024 --out out/report.html
chromium --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
  --hide-scrollbars --window-size=1400,860 --virtual-time-budget=4000 --screenshot=$pictures/report.png \
  "file://$PWD/out/report.html#frame=70&color=stretch" 2>/dev/null

# The window presses its keys by itself: the scene's motion, color by edge stretch, a picture; then arrows from the
# motion's last steps, and another.
rm -rf out/window
mkdir -p out/window
xvfb-run -a -s '-screen 0 1280x800x24' $gracilis view demo --view posterolateral --pictures out/window \
  --keys 'v m v v c c c c p c c c v p q'
mv out/window/gracilis_0001.png $pictures/window.png
mv out/window/gracilis_0002.png $pictures/window_arrows.png

for picture in $pictures/*; do
  size=$(stat --format=%s "$picture")
  echo "$picture: $((size / 1024)) KiB"
  ((size < 400 * 1024)) || { echo "too large for the README (400 KiB)" >&2; exit 1; }
done
