#!/bin/sh
# sh view_x11_test.sh VIEW_X11_TEST FORELOCK OUT: the window as a desktop sees it, with validation layers on.
set -eu
test=$1
forelock=$2
out=$3/x11
mkdir -p "$out"
sed 's/"strands": *[0-9]*/"strands": 300/' "$FORELOCK_HAIRASSETS/short-straight.json" >"$out/small.json"
grep -q '"strands": 300' "$out/small.json" || { echo "the small groom was not made" >&2; exit 1; }
exec "$test" "$forelock" "$out/small.json" "$out"
