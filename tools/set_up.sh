# shellcheck shell=bash
# Sourced by the scripts at the root: packages, configuration, build. Fetches nothing when all is there.

# Installs what packages.txt lists and this machine lacks. Only then is root (or sudo) needed.
install_packages() {
  local package missing=()
  while read -r package; do
    [[ -z $package || $package == \#* ]] && continue
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
  done <packages.txt
  [[ ${#missing[@]} -eq 0 ]] && return

  local as_root=()
  if [[ $(id -u) -ne 0 ]]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing: ${missing[*]}" >&2
      echo "Install them as root: apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# As many compilers as there are processors, but no more than memory holds (twenty source files compiled as one, or one with CGAL, take up to 3 GB).
build_jobs() {
  local processors gigabytes
  processors=$(nproc)
  gigabytes=$(awk '/^MemAvailable/ { print int($2 / 3000000) }' /proc/meminfo)
  ((gigabytes < 1)) && gigabytes=1
  echo $((processors < gigabytes ? processors : gigabytes))
}

# build PRESET [TARGET...]: configures where necessary and builds. Configuring again finds new packages and files.
build() {
  local preset=$1 output
  shift
  output=$(cmake --preset "$preset" 2>&1) || {
    echo "$output" >&2
    exit 1
  }
  cmake --build --preset "$preset" --parallel "$(build_jobs)" ${1:+--target "$@"}
}
