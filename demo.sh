#!/usr/bin/env bash
# Installs what is missing, builds Gracilis and flexes the built-in hip, or elbow: ./demo.sh [elbow] [options of 'gracilis demo']
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source tools/set_up.sh

install_packages
build release gracilis_program >&2
build/release/bin/gracilis demo --out out/demo --force "$@" >/dev/null

echo
echo "The muscles have moved."
echo "  A picture:                   $PWD/out/demo/preview.png"
echo "  All frames, for ParaView:    $PWD/out/demo/run.pvd"
echo "  What was measured:           $PWD/out/demo/measures.csv"
page=$PWD/build/release/gracilis.html
if [[ -f $page ]]; then
  echo "  The hip alive, in a browser: $page"
else
  echo "  The hip alive, in a browser: ninja -C build/release gracilis_web    (some minutes; makes $page)"
fi
