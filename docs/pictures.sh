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

# The README's table shows pictures about 400 pixels wide, so these are small enough for letters of 11 pixels there.
$gracilis render out/elbow --out $pictures/elbow.png --size 540x420 --frames 0,65
$gracilis render out/demo --out $pictures/flexion.gif --size 364x416 --step 2 --rate 20 --view posterolateral
$gracilis render out/demo --out $pictures/fibers.png --size 540x420 --frames 0,90 --view posterolateral \
  --color-by fiber-strain
$gracilis render out/demo --compare out/demo_thesis_2024 --out $pictures/stretch.png --size 540x400 --frames 90 \
  --view posterolateral --color-by edge-stretch

$gracilis report out/demo out/demo_thesis_2024 --out out/report.html
report_picture() { # NAME WIDTH HEIGHT COLOR [PAGE]
  chromium --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
    --hide-scrollbars "--window-size=$2,$3" --virtual-time-budget=4000 "--screenshot=$pictures/$1.png" \
    "file://$PWD/out/${5:-report.html}#frame=70&color=$4" 2>/dev/null
}
# A page of 890 pixels shows these, so their letters of 12.5 and 13 pixels are 11 there.
report_picture report 1010 860 natural
report_picture report_tablet 768 1024 stretch
# As a telephone shows it: within a page, since this Chromium opens no window of less than 500 pixels.
echo '<body style="margin: 0; background: #bbb"><iframe src="report.html#frame=70&amp;color=natural"
  style="display: block; margin: 0 auto; border: 0; width: 390px; height: 844px"></iframe>' >out/narrow.html
report_picture report_narrow 500 844 natural narrow.html

# The window presses its keys by itself. As it opens, in three sizes, at the end of the run:
rm -rf out/window
mkdir -p out/window
for size in 800x600 1280x720 1920x1080; do
  xvfb-run -a -s '-screen 0 1920x1080x24' $gracilis view out/demo --size $size --pictures out/window --keys 'End p q'
done
mv out/window/gracilis_0001.png $pictures/window_small.png
mv out/window/gracilis_0002.png $pictures/window_medium.png
mv out/window/gracilis_0003.png $pictures/window_large.png
# The scene's motion, color by edge stretch, a picture; then arrows from the motion's last steps, and another.
xvfb-run -a -s '-screen 0 1280x800x24' $gracilis view demo --view posterolateral --size 1000x640 --pictures out/window \
  --keys 'v m v v c c c c c p c c c c c c b w v p q'
mv out/window/gracilis_0001.png $pictures/window.png
mv out/window/gracilis_0002.png $pictures/window_arrows.png

for picture in $pictures/*; do
  size=$(stat --format=%s "$picture")
  echo "$picture: $((size / 1024)) KiB"
  ((size < 400 * 1024)) || { echo "too large for the README (400 KiB)" >&2; exit 1; }
done
