#!/bin/sh
# Dependencies between rooms run one way (docs/architecture.md): check_rooms.sh ROOT. Looks at every #include of ours,
# finds the file it means, and compares it with what the including room may see. Prints each breach as FILE: include.
set -eu
cd "$1"

rooms=$(mktemp)
found=$(mktemp)
trap 'rm -f "$rooms" "$found"' EXIT

# room, a space, extended regular expression of the paths it may include. The first room that holds a file counts.
# "vulkan" stands for any Vulkan header, "generated" for a header that the build writes. System headers are free.
common='sdk/src/host/.*|sdk/include/forelock/forelock\.h'
cpu="$common|sdk/include/forelock/(asset|rig)\.h"
public='sdk/include/forelock/.*'
cat >"$rooms" <<RULES
sdk/include/ $public|vulkan
sdk/src/host/ $common
sdk/src/asset/ $cpu|sdk/src/asset/.*
sdk/src/plan/ $cpu|sdk/src/plan/.*|shaders/shared/.*
sdk/src/passes/ $common|$public|sdk/src/(passes|plan)/.*|shaders/shared/.*|vulkan
sdk/src/gpu/ $common|$public|sdk/src/(gpu|passes|plan)/.*|shaders/shared/.*|vulkan|generated
sdk/src/api/ $common|$public|sdk/src/(api|gpu|passes|plan|asset)/.*|shaders/shared/.*|vulkan
shaders/shared/ shaders/shared/.*
shaders/lib/ shaders/(lib|shared)/.*
shaders/passes/ shaders/(passes|lib|shared)/.*
samples/common/opaque_pipelines. $public|samples/common/.*|vulkan|generated
samples/common/ $public|samples/common/.*|vulkan
samples/study/dense. $public|samples/(common|study)/.*|tests/reference/.*|shaders/.*|vulkan|generated
samples/study/ $public|samples/(common|study)/.*|tests/reference/.*|vulkan|generated
samples/minimal/ $public|vulkan
samples/ $public|samples/.*|vulkan|generated
tests/consumer/ $public|samples/common/.*|tests/consumer/.*|vulkan
tests/reference/ tests/reference/.*
RULES

# Where an include of a file is: beside it, or under one of the include roots of the build.
locate() {  # locate INCLUDING-FILE INCLUDE
  for place in "$(dirname "$1")" sdk/src sdk/include sdk/include/forelock shaders samples samples/common tests; do
    if [ -f "$place/$2" ]; then
      # "a/../b" becomes "b", so that a way around through the parent folder is seen.
      resolved=$(cd "$(dirname "$place/$2")" && pwd -P)/$(basename "$2")
      printf '%s\n' "${resolved#"$(pwd -P)"/}"
      return 0
    fi
  done
  case $2 in
    vulkan/* | volk.h) echo vulkan ;;
    *) echo generated ;;
  esac
}

find sdk shaders samples tests/consumer tests/reference -type f \( -name '*.h' -o -name '*.hpp' -o -name '*.c' \
  -o -name '*.cpp' -o -name '*.glsl' -o -name '*.vert' -o -name '*.frag' -o -name '*.comp' \) 2>/dev/null | sort |
while read -r file; do
  allowed=$(awk -v file="$file" 'index(file, $1) == 1 { print $2; exit }' "$rooms")
  sed -n 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*\([<"]\)\([^>"]*\)[>"].*/\1 \2/p' "$file" |
  while read -r quote include; do
    target=$(locate "$file" "$include")
    # <...> that is not ours and not Vulkan is the system's or a library's.
    if [ "$quote" = '<' ] && [ "$target" = generated ]; then continue; fi
    printf '%s\n' "$target" | grep -E -x -q "$allowed" || echo "$file: $include"
  done
  # Only the GPU room calls Vulkan; a function passed on by name (no parenthesis) is not a call.
  case $file in
    sdk/src/gpu/*) ;;
    sdk/src/*) grep -E -n '(^|[^A-Za-z0-9_"])vk[A-Z][A-Za-z0-9]*[[:space:]]*\(' "$file" | sed "s|^|$file: calls Vulkan at |" || true ;;
  esac
done >"$found"

# Build files: what a room may not include it may not be given either.
find samples tests/consumer -name CMakeLists.txt 2>/dev/null | while read -r file; do
  grep -n 'sdk/src\|forelock_\(asset\|render\)_objects' "$file" | sed "s|^|$file: |" >>"$found" || true
done
if [ -f tests/reference/CMakeLists.txt ]; then
  grep -n 'sdk/\|shaders\|forelock::\|forelock_\(asset\|render\|static\|shared\)' tests/reference/CMakeLists.txt |
    sed 's|^|tests/reference/CMakeLists.txt: |' >>"$found" || true
fi

if [ -s "$found" ]; then
  echo "against the direction of the rooms:"
  cat "$found"
  exit 1
fi
echo "every room sees only what it may"
