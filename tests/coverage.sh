#!/bin/sh
# Line coverage of the readers by their own tests: sh tests/coverage.sh
set -eu
case ${1:-} in
  -h | --help | -*)
    cat <<'TEXT'
usage: sh tests/coverage.sh [FOLDER]

Builds test_asset and test_gltf with --coverage in FOLDER [build/coverage], runs them, and prints the share of lines that ran of each reader
and of all together. Exits with 1 if fewer than 95 of 100 lines of any file ran, or a test failed. Needs gcov, of build-essential.
TEXT
    exit 0 ;;
esac
cd "$(dirname "$0")/.."
. samples/setup.sh

bound=95
folder=${1:-build/coverage}
# What reads bytes of files or judges them; each has to be among the measured.
readers='*_codec.cpp tfx*_reader.cpp cooked_reader.cpp sniff.cpp sanitise.cpp rig_arrays.cpp loaded_rig.cpp suspicions.cpp file_io.cpp findings.cpp cursor.h text_cursor.h gltf_accessor.cpp gltf_chains.cpp gltf_document.cpp gltf_files.cpp gltf_json.cpp gltf_nodes.cpp gltf_primitive.cpp gltf_reader.cpp gltf_sniff.cpp'

# -O0 keeps lines apart.
configure "$folder" -DCMAKE_BUILD_TYPE=Debug -DFORELOCK_TESTS=ON -DCMAKE_CXX_FLAGS="--coverage -O0" -DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_COMPILER=gcc
build "$folder" test_asset test_gltf
folder=$(cd "$folder" && pwd)
find "$folder" -name '*.gcda' -exec rm -f {} +
tests=0
(cd "$folder" && ./test_asset >coverage_tests.log 2>&1) || tests=$?
(cd "$folder" && ./test_gltf >>coverage_tests.log 2>&1) || tests=$?
if [ "$tests" != 0 ]; then
  grep 'FAILED' "$folder/coverage_tests.log" >&2 || true
fi

root=$(pwd)
work=$folder/gcov
rm -rf "$work"
mkdir "$work"
# A file of lines a source, for each object in a folder of its own. The objects of the tests as well: of a function in a header the linker
# keeps one copy, and that one counts.
find "$folder" -name '*.gcda' | sort | while read -r data; do
  into=$work/$(basename "$data" .gcda)
  mkdir -p "$into"
  (cd "$into" && gcov -p "$data" >/dev/null 2>&1)
done

# A line of a header ran if it ran from any object. "-": no code, "#####" and "=====": did not run.
status=0
find "$work" -name '*.gcov' | sort | xargs cat | awk -F: -v root="$root/" -v bound=$bound -v readers="$readers" '
  function shape(glob) { gsub(/\./, "\\.", glob); gsub(/\*/, "[^/]*", glob); return "^" glob "$" }
  BEGIN { globs = split(readers, glob, " "); for (i = 1; i <= globs; ++i) pattern[i] = shape(glob[i]) }
  $2 + 0 == 0 && $3 == "Source" { source = $4; name = substr(source, length(root) + 1); wanted = index(source, root) == 1 && sub(/^(sdk\/src\/asset|samples\/common)\//, "", name); next }
  !wanted { next }
  {
    known = 0
    for (i = 1; i <= globs; ++i) if (name ~ pattern[i]) { known = 1; found[i] = 1 }
    count = $1
    gsub(/[ *]/, "", count)
    if (!known || count == "-" || $2 + 0 == 0) next
    line = name ":" ($2 + 0)
    if (!(line in seen)) { seen[line] = 1; lines[name]++ }
    if (count !~ /^[#=%]/ && !(line in hit)) { hit[line] = 1; ran[name]++ }
  }
  END {
    for (i = 1; i <= globs; ++i) if (!(i in found)) { print "not measured: " glob[i]; bad = 1 }
    for (name in lines) {
      share = 100 * ran[name] / lines[name]
      printf "%-28s %5d of %5d lines  %6.1f %%%s\n", name, ran[name], lines[name], share, share < bound ? "  below " bound " %" : "" | "sort"
      if (share < bound) bad = 1
      all += lines[name]; all_ran += ran[name]
    }
    close("sort")
    if (all == 0) { print "nothing was measured"; exit 1 }
    printf "%-28s %5d of %5d lines  %6.1f %%\n", "together", all_ran, all, 100 * all_ran / all
    for (line in seen) if (!(line in hit)) print line >"missed.txt"
    exit bad
  }' || status=1
if [ -f missed.txt ]; then mv missed.txt "$work/missed.txt"; fi
[ "$tests" = 0 ] && [ "$status" = 0 ]
