#!/usr/bin/env bash
# Makes the packages of a build folder and tries them: tools/packages.sh [BUILD_FOLDER] [--clean-root]
#   build/release/packages/*.deb    gracilis, libgracilis-dev, python3-gracilis
# With the page for `gracilis report --live` where clang compiles for WebAssembly (docs/guide/web.md).
# lintian may find no error (where it is installed). With --clean-root they are also installed with all that they depend on in a
# Debian of their own (mmdebstrap, fetches packages) and used there; without, gracilis runs unpacked with an empty environment.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=build/release
clean_root=
for option in "$@"; do
  case $option in
    --clean-root) clean_root=yes ;;
    -*)
      echo "usage: tools/packages.sh [BUILD_FOLDER] [--clean-root]" >&2
      exit 2
      ;;
    *) folder=$option ;;
  esac
done
folder=$(realpath "$folder")
packages=$folder/packages
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

rm -rf "$packages"
page=
[[ $(cmake --build "$folder" --target help) == *gracilis_web:* ]] && page=gracilis_web
cmake --build "$folder" --target gracilis_program gracilis_python ${page:+"$page"}
(cd "$folder" && cpack) >"$work/cpack.log" 2>&1 || {
  cat "$work/cpack.log" >&2
  exit 1
}
ls -l "$packages"/*.deb

if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error --tag-display-limit 3 "$packages"/*.deb
else
  echo "skipped: lintian is not installed"
fi

# What a user does first.
use='set -e
cd "$(mktemp -d)"
gracilis --version
gracilis demo --flexion 5 --out hip
gracilis verify hip
[ "$(gracilis complete "gracilis ro")" != "" ]'
if [[ -n $page ]]; then
  use+='
gracilis report hip --live'
else
  echo "skipped: no page for the browser is built here"
fi

if [[ -z $clean_root ]]; then
  dpkg-deb -x "$packages"/gracilis_*.deb "$work/root"
  dpkg-deb -x "$packages"/python3-gracilis_*.deb "$work/root"
  env -i HOME="$work" PATH="$work/root/usr/bin:/usr/bin:/bin" bash -c "$use"
  env -i HOME="$work" PYTHONPATH="$work/root/usr/lib/python3/dist-packages" \
    /usr/bin/python3 -B -c 'import gracilis; print(gracilis.__version__, gracilis.__file__)'
  exit
fi

mkdir "$work/root"
mmdebstrap --variant=apt --quiet bookworm "$work/root" \
  --customize-hook="mkdir -p \"\$1/packages\" && cp $packages/*.deb \"\$1/packages\"" \
  --customize-hook='chroot "$1" sh -c "DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends cmake g++ make /packages/*.deb >/dev/null"'
mount --bind /proc "$work/root/proc"  # the program looks there for what is installed beside it
trap 'umount "$work/root/proc"; rm -rf "$work"' EXIT
chroot "$work/root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "$use"
chroot "$work/root" env -i HOME=/root PATH=/usr/bin:/bin python3 -c '
import gracilis
simulation = gracilis.Simulation(gracilis.demo())
simulation.advance({"hip_flexion_r": 1.0})
print("python:", gracilis.__version__, simulation.muscles["iliacus_r"].volume)'
# Whether all is there that the headers and libraries stand on.
chroot "$work/root" env -i HOME=/root PATH=/usr/bin:/bin sh -c 'set -e
cd "$(mktemp -d)"
cat >CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.25)
project(uses_gracilis LANGUAGES C CXX)
find_package(gracilis REQUIRED COMPONENTS core toolkit)
add_executable(says_methods main.cpp)
target_link_libraries(says_methods PRIVATE gracilis::core)
END
cat >main.cpp <<END
#include <gracilis/methods/registry.hpp>
int main() { return gracilis::methods().empty(); }
END
cmake -S . -B build >/dev/null
cmake --build build
build/says_methods'
