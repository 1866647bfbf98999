#!/usr/bin/env bash
# Makes the pictures in docs/pictures: demo.png is the preview of ./demo.sh, as it is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

./demo.sh
mkdir -p docs/pictures
cp out/demo/preview.png docs/pictures/demo.png
size=$(stat --format=%s docs/pictures/demo.png)
echo "docs/pictures/demo.png: $((size / 1024)) KiB"
((size < 400 * 1024)) || { echo "too large for the README (400 KiB)" >&2; exit 1; }
