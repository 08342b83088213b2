#!/bin/sh
# check_rooms.sh must catch a breach: check_rooms_itself.sh CHECK_ROOMS. Each line below is a file and what it includes.
set -eu
check=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

plant() {  # plant FILE LINE
  mkdir -p "$tree/$(dirname "$1")"
  printf '%s\n' "$2" >>"$tree/$1"
}
clean() {
  rm -rf "${tree:?}"/*
  plant sdk/include/forelock/forelock.h ''
  plant sdk/include/forelock/render.h '#include <vulkan/vulkan.h>'
  plant sdk/src/host/memory.h '#include "forelock/forelock.h"'
  plant sdk/src/asset/strands.h '#include <vector>'
  plant sdk/src/plan/plan.h '#include "host/memory.h"'
  plant sdk/src/gpu/device.h '#include "plan/plan.h"'
  plant shaders/shared/node.h ''
  plant shaders/lib/shade.glsl '#include "../shared/node.h"'
  plant shaders/passes/resolve.comp '#include "lib/shade.glsl"'
  plant samples/common/groom.h '#include <forelock/forelock.h>'
  plant tests/reference/shade.h '#include <cmath>'
}
expectCaught() {  # expectCaught FILE LINE
  clean
  plant "$1" "$2"
  if sh "$check" "$tree" >/dev/null; then
    echo "not caught: $1: $2"
    exit 1
  fi
}

clean
sh "$check" "$tree"
expectCaught sdk/src/plan/pass.cpp '#include <vulkan/vulkan.h>'
expectCaught sdk/src/plan/pass.cpp '#include "forelock/render.h"'
expectCaught sdk/src/plan/pass.cpp '#include "gpu/device.h"'
expectCaught sdk/src/plan/pass.cpp '#include "../gpu/device.h"'
expectCaught sdk/src/asset/tfx.cpp '#include "plan/plan.h"'
expectCaught sdk/src/passes/clear.cpp 'void clear() { vkCmdDispatch(cmd, 1, 1, 1); }'
expectCaught sdk/src/host/memory.cpp '#include "asset/strands.h"'
expectCaught shaders/shared/head.h '#include "lib/shade.glsl"'
expectCaught shaders/lib/pack.glsl '#include "passes/resolve.comp"'
expectCaught samples/forelock/main.cpp '#include "asset/strands.h"'
expectCaught samples/minimal/minimal.c '#include "common/groom.h"'
expectCaught tests/reference/render.cpp '#include "forelock/forelock.h"'
expectCaught tests/reference/render.cpp '#include "../../shaders/lib/shade.glsl"'
echo "every breach is caught"
