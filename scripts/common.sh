# shellcheck shell=bash
# What the scripts of this folder share; sourced, not run.
#
#   use_packages GROUP...        installs what is missing of these groups of scripts/packages
#   build PRESET TARGET TESTS    configures build/PRESET when needed and builds TARGET (TESTS: ON or OFF)
#   is_built PRESET TARGET       true when that would do nothing; reads only, some 20 ms
#
# Nothing here writes to standard output.  A failure ends the script with kSetupFailed.

set -euo pipefail

root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
readonly root
readonly kSetupFailed=125  # as timeout(1) and env(1): the tool itself never ran

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }

die() {
  say "$@"
  exit "$kSetupFailed"
}

# Packages of the groups named, one per line.
packages_of() {
  awk -v groups=" $* " '!/^#/ && index(groups, " " $1 " ") { print $2 }' "$root/scripts/packages"
}

# Those of the packages named that are not installed, one per line.
missing_packages() {
  local installed
  # shellcheck disable=SC2016  # the format is dpkg-query's, not the shell's
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  local package
  for package in "$@"; do
    [[ $'\n'$installed$'\n' == *$'\n'"installed $package"$'\n'* ]] || printf '%s\n' "$package"
  done
}

use_packages() {
  local -a wanted missing sudo=()
  mapfile -t wanted < <(packages_of "$@")
  if ! command -v dpkg-query > /dev/null; then
    say "not a Debian system; going on with what is there.  Needed: ${wanted[*]}"
    return
  fi
  mapfile -t missing < <(missing_packages "${wanted[@]}")
  ((${#missing[@]})) || return 0

  local remedy="apt-get install --no-install-recommends ${missing[*]}"
  if ((EUID != 0)); then
    command -v sudo > /dev/null ||
      die "missing Debian packages: ${missing[*]}"$'\n'"Neither root nor sudo here; ask for this, then try again:"$'\n'"  $remedy"
    sudo=(sudo)
  fi
  say "installing, first time only: ${missing[*]}"
  local log=$root/build/packages.log
  # A stale or partly unreachable index is no failure as long as the packages themselves arrive.
  "${sudo[@]}" apt-get -o DPkg::Lock::Timeout=600 update > "$log" 2>&1 9>&- || true
  if ! "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 \
      install -y --no-install-recommends "${missing[@]}" >> "$log" 2>&1 9>&-; then
    tail -n 15 "$log" >&2
    die "missing Debian packages: ${missing[*]}"$'\n'"They could not be installed: apt-get's last words stand above, all of them in $log."$'\n'"With a network and a Debian 12 mirror this does it, then try again:"$'\n'"  $remedy"
  fi
}

# The stamp holds the path of the checkout: a copied or moved build folder must not pass.
is_configured() {
  local dir=$root/build/$1
  [[ -f $dir/build.ninja && -f $dir/.configured && $(< "$dir/.configured") == "$root" &&
    ! $root/CMakePresets.json -nt $dir/.configured ]]
}

has_tests() { grep -q '^NDA_BUILD_TESTS:BOOL=ON$' "$root/build/$1/CMakeCache.txt" 2> /dev/null; }

is_built() {
  is_configured "$1" && [[ $(ninja -C "$root/build/$1" -n "$2" 2> /dev/null) == *'no work to do'* ]]
}

# Runs a command with its output in a log that is shown only on failure.
logged() {
  local log=$1
  shift
  "$@" > "$log" 2>&1 9>&- && return
  tail -n 60 "$log" >&2
  die "failed: ${*:1:2} ...; the whole log is $log"
}

configure() {
  local preset=$1 tests=$2 dir=$root/build/$1
  if [[ -e $dir && ! (-f $dir/.configured && $(< "$dir/.configured") == "$root") ]]; then
    rm -rf -- "$dir"
  fi
  mkdir -p -- "$dir"
  logged "$dir/configure.log" cmake -S "$root" --preset "$preset" "-DNDA_BUILD_TESTS=$tests"
  printf '%s\n' "$root" > "$dir/.configured"
}

build() {
  local preset=$1 target=$2 tests=$3 dir=$root/build/$1
  if has_tests "$preset"; then tests=ON; fi
  if ! is_configured "$preset" || { [[ $tests == ON ]] && ! has_tests "$preset"; }; then
    configure "$preset" "$tests"
  fi
  is_built "$preset" "$target" && return
  say "building (minutes the first time, seconds later); log in build/$preset/build.log"
  logged "$dir/build.log" cmake --build "$dir" --target "$target" --parallel "$(nproc)"
}

# One installation or build at a time in this checkout.
lock() {
  mkdir -p -- "$root/build" 2> /dev/null || true
  { exec 9> "$root/build/.lock"; } 2> /dev/null ||
    die "cannot write to $root/build; run as its owner or use a checkout of your own"
  flock --nonblock 9 && return
  say "waiting for another build in this checkout"
  flock 9
}

unlock() { exec 9>&-; }
