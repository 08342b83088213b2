#!/bin/sh
# sh view_test.sh FORELOCK FOLDER-OF-SCRIPTS OUT [FORELOCK-WITH-LEAKSANITIZER]: the window under Xvfb, with validation layers on.
set -eu
forelock=$1
scripts=$2
out=$3
leak=${4:-}
mkdir -p "$out"
cd "$out"
[ -n "${FORELOCK_XVFB_RUN:-}" ] && [ -x "$FORELOCK_XVFB_RUN" ] || { echo "xvfb-run is not installed: package xvfb" >&2; exit 1; }
window() { "$FORELOCK_XVFB_RUN" -a -s "-screen 0 1400x900x24" "$forelock" view --forget --validation "$@"; }

# A small groom, so that every frame is quick.
sed 's/"strands": *[0-9]*/"strands": 300/' "$FORELOCK_HAIRASSETS/short-straight.json" >small.json
grep -q '"strands": 300' small.json || { echo "the small groom was not made" >&2; exit 1; }

# A mesh of four triangles to put beside it.
cat >wedge.gltf <<'END'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-0.25,-0.35,-0.25],"max":[0.25,-0.05,0.3]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,AACAvjMzs74AAIC+AACAPjMzs74AAIC+AAAAADMzs76amZk+AAAAAM3MTL0AAAAAAAACAAEAAAABAAMAAQACAAMAAgAAAAMA"}]}
END

echo "-- a tour"
rm -f at-once.png later.png tour.png tour.sh command.png tour-window.png
window small.json --window 1100x700 --script "$scripts/tour.txt"
[ -s tour-window.png ] || { echo "no picture of the window" >&2; exit 1; }

cmp at-once.png later.png || { echo "a picture that was saved while shaders were compiled is another" >&2; exit 1; }

echo "-- the command line that it copied makes the same picture"
PATH=$(dirname "$forelock"):$PATH sh ./tour.sh >/dev/null
cmp tour.png command.png || { echo "the pictures differ" >&2; exit 1; }

echo "-- every widget"
window small.json --window 1100x700 --script "$scripts/walk.txt"

if [ -n "$leak" ]; then
  echo "-- nothing is leaked"
  # What a library keeps that is unloaded by then has no name to be suppressed by: a leak is ours where our program is on its stack.
  LSAN_OPTIONS=exitcode=0:suppressions=$scripts/lsan.supp "$FORELOCK_XVFB_RUN" -a -s "-screen 0 1400x900x24" \
    "$leak" view --forget small.json --window 1100x700 --script "$scripts/leak.txt" >leak.log 2>&1 || { cat leak.log >&2; exit 1; }
  if grep -E 'view_leak|forelock::' leak.log >&2; then cat leak.log >&2; exit 1; fi
fi

echo "-- what is no hair is said so"
printf 'version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n' >pointer.tfx
if window pointer.tfx --frames 1 2>bad.txt; then echo "a pointer was opened" >&2; exit 1; fi
grep -qi 'lfs' bad.txt || { cat bad.txt >&2; exit 1; }

echo "-- no display"
status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$forelock" view small.json --forget 2>bad.txt || status=$?
[ "$status" = 3 ] || { echo "exit status $status without a display" >&2; cat bad.txt >&2; exit 1; }
grep -q 'display' bad.txt
