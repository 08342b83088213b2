#!/bin/sh
# A project of someone else takes Forelock with add_subdirectory: check_subproject.sh SOURCE_FOLDER BUILD_FOLDER CC CXX
# Its build folder is kept, so that a second run only links.
set -eu
forelock=$1
work=$2
mkdir -p "$work"
generator=
[ -f "$work/CMakeCache.txt" ] || generator="-G Ninja"
# shellcheck disable=SC2086
cmake -S "$forelock/tests/consumer/subproject" -B "$work" $generator -DFORELOCK_FOLDER="$forelock" \
  -DCMAKE_C_COMPILER="$3" -DCMAKE_CXX_COMPILER="$4" -DCMAKE_BUILD_TYPE=Debug
for option in FORELOCK_COMMAND FORELOCK_STUDY FORELOCK_TESTS FORELOCK_FUZZ; do
  grep -q "^$option:BOOL=OFF" "$work/CMakeCache.txt" || { echo "$option is not OFF in a subproject"; exit 1; }
done
cmake --build "$work" --parallel 2
"$work/consumer_c"
"$work/consumer_cpp"
