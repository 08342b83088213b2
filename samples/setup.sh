# Set-up shared by samples/quickstart.sh and tests/run.sh, which source it from the root of the repository.
# POSIX sh. Each step does nothing when its result is already there.

say() { printf '%s\n' "-- $*"; }
fail() { printf '%s\n' "error: $*" >&2; exit 1; }

# Packages of samples/dependencies.txt for the uses named, for example: listedPackages build test
listedPackages() {
  for use in "$@"; do
    awk -v use="$use" '$1 == use { print $2 }' samples/dependencies.txt
  done
}

installPackages() {
  packages=$(listedPackages "$@")
  if ! command -v dpkg-query >/dev/null 2>&1 || ! command -v apt-get >/dev/null 2>&1; then
    say "not a Debian system: nothing is installed; what is needed is called like this there:" $packages
    return 0
  fi
  missing=
  for package in $packages; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) || status=
    [ "$status" = installed ] || missing="$missing $package"
  done
  if [ -z "$missing" ]; then
    say "packages: all there"
    return 0
  fi
  as_root=
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null 2>&1 ||
      fail "not root and no sudo: as root, run: apt-get install --no-install-recommends$missing"
    as_root=sudo
    [ -t 0 ] || as_root="sudo -n"  # nobody is there to type a password
  fi
  say "packages: installing$missing"
  # A source that cannot be reached is not the end: what is needed may come from another one.
  $as_root apt-get update -q || say "apt-get update failed; trying with the lists at hand"
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing ||
    fail "packages could not be installed:$missing"
}

# Processors to build with. A compiler takes up to about 1 GiB: a small machine builds with fewer.
jobCount() {
  processors=$(getconf _NPROCESSORS_ONLN 2>/dev/null) || processors=2
  by_memory=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo 2>/dev/null)
  if [ -n "$by_memory" ] && [ "$by_memory" -lt "$processors" ]; then processors=$by_memory; fi
  [ "$processors" -ge 1 ] 2>/dev/null || processors=1
  echo "$processors"
}

# configure FOLDER cmake-options... : quiet when all is well, and ninja decides what is stale.
configure() {
  folder=$1
  shift
  mkdir -p "$folder"
  # A folder that was configured with another generator keeps it.
  [ -f "$folder/CMakeCache.txt" ] || set -- -G Ninja "$@"
  if ! cmake -S . -B "$folder" "$@" >"$folder/configure.log" 2>&1; then
    cat "$folder/configure.log" >&2
    fail "cmake could not configure $folder"
  fi
}

# build FOLDER targets... : all of them when none is named.
build() {
  folder=$1
  shift
  if [ $# -gt 0 ]; then set -- --target "$@"; fi
  cmake --build "$folder" --parallel "$(jobCount)" "$@" || fail "the build in $folder failed"
}
