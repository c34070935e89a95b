#!/usr/bin/env bash
# Installs what Hemoflux needs, builds it and runs it: ./bootstrap.sh run|test|build [--dry-run]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

packages=(
  g++ cmake ninja-build ccache                                  # compiler and build
  libthrust-dev libtbb-dev libeigen3-dev libfmt-dev             # loops, linear algebra, text
  libcgal-dev libgmsh-dev libvtk9-dev libjsoncpp-dev libboost-dev # meshes, files, pictures
  libcli11-dev libtomlplusplus-dev libudunits2-dev libspdlog-dev # command line, case files, units, log
  libmuparser-dev                                               # expressions in case files
  liblbfgspp-dev                                                # static relaxation
  libgtest-dev libbenchmark-dev                                 # tests
  gnuplot-nox xvfb xauth libgl1-mesa-dri fonts-dejavu-core      # plots and pictures
  pybind11-dev python3-dev python3-numpy                        # Python package
)
# Checks of changes to the code; installed where CI=true.
[[ ${CI:-} == true ]] && packages+=(doxygen chromium)
preset=release
case_file=apps/cases/tank_treading_quick.toml
results=results/tank_treading_quick

usage() {
  cat <<'TEXT'
usage: ./bootstrap.sh run|test|build [--dry-run]

  run        install what is missing, build, and run the default case into results/
  test       install what is missing, build, and run the tests
  build      install what is missing and build the program
  --dry-run  say what would be installed and done, and do nothing

Installing takes place on Debian and Ubuntu, by apt-get, as root or with sudo.
TEXT
}

say() { printf '\033[1m== %s\033[0m\n' "$*"; }
stop() {
  printf 'bootstrap: %s\n' "$*" >&2
  exit 1
}

# Runs a command, or prints it under --dry-run.
do_it() {
  if [[ $dry_run == yes ]]; then
    printf '  %s\n' "$*"
  else
    "$@"
  fi
}

is_debian_like() {
  [[ -r /etc/os-release ]] || return 1
  # shellcheck disable=SC1091
  (. /etc/os-release && [[ " ${ID:-} ${ID_LIKE:-} " =~ \ (debian|ubuntu)\  ]])
}

list_missing() {
  local package
  for package in "${packages[@]}"; do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || printf '%s\n' "$package"
  done
}

# Whether apt knows a version of each package; on a fresh system it knows none before an update.
apt_knows() {
  local package
  for package in "$@"; do
    apt-cache policy "$package" 2>/dev/null | grep -q 'Candidate: [^(]' || return 1
  done
}

install_missing() {
  local missing as_root=()
  mapfile -t missing < <(list_missing)
  if ((${#missing[@]} == 0)); then
    say "All ${#packages[@]} packages are installed"
    return
  fi
  say "Packages to install: ${missing[*]}"
  if ((EUID != 0)); then
    command -v sudo >/dev/null || [[ $dry_run == yes ]] ||
      stop "installing needs root and there is no sudo; as root: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  apt_knows "${missing[@]}" || do_it "${as_root[@]}" apt-get update
  do_it "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}

# Compilations side by side: a core each, but 2 GiB of memory as well (CGAL, VTK and nvcc are hungry).
parallel_jobs() {
  local cores memory jobs
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ {print int($2 / 2097152)}' /proc/meminfo)
  jobs=$((memory < cores ? memory : cores))
  echo $((jobs < 1 ? 1 : jobs))
}

build() {
  local jobs
  jobs=$(parallel_jobs)
  say "Building preset $preset with $jobs at a time"
  # Warnings are errors for those who change the code, not for those who use it with another compiler.
  do_it cmake --preset "$preset" -D HEMOFLUX_WERROR="$([[ ${CI:-} == true ]] && echo ON || echo OFF)"
  do_it cmake --build --preset "$preset" --parallel "$jobs" "$@"
}

command=${1:-}
dry_run=no
case ${2:-} in
  '') ;;
  --dry-run) dry_run=yes ;;
  *) usage >&2; exit 2 ;;
esac
(($# <= 2)) || { usage >&2; exit 2; }
case $command in
  run | test | build) ;;
  -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

if ! is_debian_like; then
  printf 'Not Debian or Ubuntu: install what these Debian packages hold, then build with CMake >= 3.25:\n' >&2
  printf '  %s\n' "${packages[@]}" >&2
  printf '  cmake --preset %s && cmake --build --preset %s\n' "$preset" "$preset" >&2
  exit 1
fi

install_missing
case $command in
  build) build --target hemoflux ;;
  run)
    build --target hemoflux
    say "Running $case_file into $results"
    do_it "build/$preset/apps/hemoflux" run "$case_file" --output "$results"
    ;;
  test)
    build
    say "Testing"
    # waiting threads yield, since several tests share the cores
    do_it env OMP_WAIT_POLICY=passive ctest --test-dir "build/$preset" --output-on-failure \
      --label-exclude validation --parallel "$(parallel_jobs)"
    ;;
esac
