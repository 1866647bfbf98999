#!/usr/bin/env bash
# Makes the pictures in docs/pictures: the previews of ./demo.sh in both settings, as they are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

./demo.sh
build/release/bin/gracilis demo --preset thesis-2024 --out out/demo_thesis_2024 --force
mkdir -p docs/pictures
cp out/demo/preview.png docs/pictures/demo.png
cp out/demo_thesis_2024/preview.png docs/pictures/demo_thesis_2024.png
for picture in docs/pictures/demo*.png; do
  size=$(stat --format=%s "$picture")
  echo "$picture: $((size / 1024)) KiB"
  ((size < 400 * 1024)) || { echo "too large for the README (400 KiB)" >&2; exit 1; }
done
