# shellcheck shell=bash
# Sourced by demo.sh and test.sh: what Ballast needs on Debian 12, and how it is built.
# Safe to call again: what is there is left alone. Sets nothing up outside apt and build/.

ballast_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
ballast_preset=release
ballast_build="$ballast_root/build/$ballast_preset"

# What find_package and the includes ask for. SUNDIALS integrates the stiff viscoelastic tissue; the
# font is for the report's pictures, which are drawn without an X server.
ballast_packages=(
  g++ cmake ninja-build ccache
  libeigen3-dev libsundials-dev libhdf5-dev libvtk9-dev zlib1g-dev
  libtomlplusplus-dev libcli11-dev libfmt-dev nlohmann-json3-dev libgtest-dev
  fonts-dejavu-core
)

say() { printf '== %s\n' "$*"; }

stop() {
  printf '\n%s: %s\n' "$(basename "$0")" "$1" >&2
  shift
  for line in "$@"; do printf '  %s\n' "$line" >&2; done
  exit 1
}

# Fills the array `missing`.
find_missing_packages() {
  local installed wanted
  installed=" $(dpkg-query -W -f='${Package}=${db:Status-Status} ' "${ballast_packages[@]}" \
    2>/dev/null || true)"
  missing=()
  for wanted in "${ballast_packages[@]}"; do
    [[ $installed == *" $wanted=installed "* ]] || missing+=("$wanted")
  done
}

require_debian_12() {
  local id="" version=""
  if [[ -r /etc/os-release ]]; then
    id="$(. /etc/os-release && printf '%s' "${ID:-}")"
    version="$(. /etc/os-release && printf '%s' "${VERSION_ID:-}")"
  fi
  if [[ $id != debian || $version != 12 ]] || ! command -v dpkg-query >/dev/null; then
    stop "this set-up is for Debian 12; here is ${id:-an unknown system} ${version}." \
      "Elsewhere install the equivalents of" \
      "${ballast_packages[*]}" \
      "and build with: cmake --preset release && cmake --build --preset release"
  fi
}

# apt as root; keeps its output in a log, which is shown when it fails.
run_apt() {
  local log="$ballast_root/build/apt.log"
  mkdir -p "$ballast_root/build"
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -q \
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 "$@" >"$log" 2>&1; then
    tail -n 15 "$log" >&2
    return 1
  fi
}

install_missing() {
  require_debian_12
  local -a missing as_root=()
  find_missing_packages
  if [[ ${#missing[@]} -eq 0 ]]; then
    say "packages: all ${#ballast_packages[@]} installed"
    return
  fi
  if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null ||
      stop "packages are missing and this is neither root nor a system with sudo." \
        "As root: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
    sudo -n true 2>/dev/null || [[ -t 0 ]] ||
      stop "packages are missing and sudo asks for a password, but there is no terminal." \
        "First: sudo apt-get install --no-install-recommends ${missing[*]}"
  fi
  [[ -r /proc/self/status ]] ||
    stop "/proc is not mounted; packages cannot be installed without it." \
      "In a chroot, from outside: mount -t proc proc DIRECTORY/proc"
  say "packages: installing ${missing[*]}"
  say "          on a bare system with what they need 620 packages, 590 MB to fetch, 2.5 GB on disk"
  run_apt update ||
    stop "apt-get update failed (above). Is there a network, and are the apt sources right?"
  # --no-remove: python3-paraview, for one, excludes libvtk9-dev; that is for the user to settle.
  run_apt install --no-install-recommends --no-remove "${missing[@]}" ||
    stop "apt-get install failed (above; all of it in build/apt.log)." \
      "No network, or a full disk? If it says that packages would have to be removed:" \
      "an installed package excludes one of ours, as python3-paraview does libvtk9-dev."
}

# One compiler takes up to 1 GB: as many as there are cores and memory for.
parallel_jobs() {
  local cores gigabytes
  cores="$(nproc)"
  gigabytes="$(awk '/^MemAvailable:/ {print int($2 / 1048576)}' /proc/meminfo 2>/dev/null || true)"
  if [[ -n $gigabytes && $gigabytes -lt $cores ]]; then cores=$gigabytes; fi
  printf '%s' "$((cores > 0 ? cores : 1))"
}

# build TARGET...: configures the preset and builds the targets.
build() {
  local log="$ballast_root/build/configure.log"
  # Objects compiled in another checkout serve here too.
  export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$ballast_root}"
  mkdir -p "$ballast_root/build"
  say "configuring preset $ballast_preset"
  (cd "$ballast_root" && cmake --preset "$ballast_preset") >"$log" 2>&1 || {
    tail -n 30 "$log" >&2
    stop "cmake failed (above; all of it in build/configure.log)."
  }
  say "building target $* in build/$ballast_preset"
  nice -n 10 cmake --build "$ballast_build" --parallel "$(parallel_jobs)" --target "$@" ||
    stop "the build failed (above)."
}
