#!/bin/sh
# Builds and runs the tests: sh tests/run.sh
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install=1
fuzz_seconds=15
sanitized='test_(asset|plan|groom|gltf|api|report)'
for argument in "$@"; do
  case $argument in
    --no-install) install=0 ;;
    --full)
      fuzz_seconds=240
      sanitized='test_(asset|plan|groom|gltf|api|report|reference)' ;;
    -h | --help)
      cat <<'TEXT'
usage: sh tests/run.sh [--full] [--no-install]

Installs the Debian packages that are missing, then
  1. builds everything (Release) in build/ and runs all tests with ctest;
  2. builds the rooms that need no GPU with AddressSanitizer and UBSan in build/sanitize and runs their tests;
  3. builds the fuzz targets with clang in build/fuzz and runs each for 15 seconds.
Exits with 0 when all passed. A second run installs and rebuilds nothing. To run less:
  ctest --test-dir build -L LABEL     labels: ctest --test-dir build --print-labels

  --full         longer fuzzing (4 minutes a target instead of 15 seconds), and sanitizers on the float64 reference too
  --no-install   install nothing; fails later if something is missing
TEXT
      exit 0 ;;
    *) fail "unknown argument '$argument'; see --help" ;;
  esac
done

passed=0
failed=0
failures=

# A test executable that fails is counted here, and the rest runs all the same.
count() {  # count NAME STATUS
  if [ "$2" = 0 ]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    failures="$failures $1"
  fi
}

runTests() {  # runTests FOLDER ctest-options...
  folder=$1
  shift
  log=$folder/ctest.log
  status=0
  ctest --test-dir "$folder" --output-on-failure --no-tests=error --output-log "$log" \
    --parallel "$(jobCount)" "$@" || status=$?
  # "97% tests passed, 1 tests failed out of 30"; a skipped or missing test is not among the passed.
  total=$(sed -n 's/.*tests passed, [0-9]* tests failed out of \([0-9]*\).*/\1/p' "$log" | tail -n 1)
  bad=$(sed -n 's/.*tests passed, \([0-9]*\) tests failed out of .*/\1/p' "$log" | tail -n 1)
  skipped=$(grep -c 'Skipped\|Not Run (Disabled)' "$log") || skipped=0
  if [ -z "$total" ]; then
    count "ctest:$folder" 1
    return 0
  fi
  passed=$((passed + total - bad - skipped))
  failed=$((failed + bad))
  if [ "$status" != 0 ] && [ "$bad" = 0 ]; then count "ctest:$folder" 1; fi
  if [ "$bad" != 0 ]; then
    failures="$failures $(sed -n 's/^[[:space:]]*[0-9]* - \([^ ]*\) (.*/\1/p' "$log" | sort -u | tr '\n' ' ')"
  fi
  if [ "$skipped" != 0 ]; then say "$skipped skipped in $folder"; fi
}

# Tests of FOLDER whose whole name matches; a test made with forelock_test is called like its target.
testsOf() {  # testsOf FOLDER extended-regular-expression
  ctest --test-dir "$1" -N | sed -n 's/^ *Test *#[0-9]*: *//p' | grep -E -x "$2" || true
}

[ $install = 0 ] || installPackages build test

say "1. everything, Release, in build/"
configure build -DCMAKE_BUILD_TYPE=Release -DFORELOCK_TESTS=ON
build build
runTests build

say "2. rooms without a GPU, with AddressSanitizer and UBSan, in build/sanitize"
# -O1: half the time to compile, and the stacks stay readable.
configure build/sanitize -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG="-O1 -g1" -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
  -DFORELOCK_SANITIZE=address,undefined
targets=$(testsOf build/sanitize "$sanitized")
[ -n "$targets" ] || fail "no test to build with sanitizers"
build build/sanitize $targets
runTests build/sanitize -R "^($(echo $targets | tr ' ' '|'))\$"

say "3. fuzz targets, $fuzz_seconds s each, in build/fuzz"
if command -v clang++ >/dev/null 2>&1; then
  configure build/fuzz -DCMAKE_BUILD_TYPE=RelWithDebInfo -DFORELOCK_FUZZ=ON -DFORELOCK_FUZZ_SECONDS="$fuzz_seconds" \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
  # One source file a target.
  build build/fuzz $(ls tests/fuzz | sed -n 's/^\(fuzz_[a-z0-9]*\)\.cpp$/\1/p')
  runTests build/fuzz -L fuzz
else
  # Only where packages are not installed by this script: no fuzzing is a failure there, not a silent pass.
  say "no clang++: the fuzz targets were not run"
  count "fuzz:no-clang" 1
fi

if [ "$failed" != 0 ]; then say "failed:$failures"; fi
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
