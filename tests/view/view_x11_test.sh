#!/bin/sh
# sh view_x11_test.sh VIEW_X11_TEST FORELOCK OUT: the window as a desktop sees it, with validation layers on.
set -eu
test=$1
forelock=$2
out=$3/x11
mkdir -p "$out"
# A small groom, so that every frame is quick, under a name that a desktop has to code; its hair alone is quicker still.
sed 's/"strands": *[0-9]*/"strands": 300/' "$FORELOCK_HAIRASSETS/short-straight.json" >"$out/two stränds.json"
grep -q '"strands": 300' "$out/two stränds.json" || { echo "the small groom was not made" >&2; exit 1; }
"$forelock" convert "$out/two stränds.json" "$out/small.hair" >"$out/convert.log" 2>&1 || { cat "$out/convert.log" >&2; exit 1; }
exec "$test" "$forelock" "$out"
