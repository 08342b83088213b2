#!/bin/sh
# The minimal engine under the validation layer, core and synchronization: check_minimal.sh FORELOCK_MINIMAL WORK_FOLDER
# Any message of the layer fails, and so does a layer that is not there.
set -eu
program=$1
work=$2
mkdir -p "$work"

VK_LOADER_DEBUG=layer VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation \
  VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT \
  "$program" - "$work/minimal.ppm" >"$work/minimal.log" 2>&1 || { cat "$work/minimal.log"; exit 1; }
grep -v '^\(INFO\|LAYER\|DEBUG\|WARNING | LAYER\|INFO | LAYER\)' "$work/minimal.log" || true
if ! grep -q 'Insert.*VK_LAYER_KHRONOS_validation' "$work/minimal.log"; then
  echo "the validation layer was not loaded: package vulkan-validationlayers"
  exit 1
fi
if grep -E -q 'VUID|SYNC-HAZARD|Validation (Error|Warning|Performance Warning)|UNASSIGNED' "$work/minimal.log"; then
  echo "the validation layer objects"
  exit 1
fi

# Hair covers a good part of the picture, and is not of one colour.
covered=$(sed -n 's/^picture.* \([0-9]*\) pixels with hair$/\1/p' "$work/minimal.log")
[ "${covered:-0}" -gt 20000 ] || { echo "only ${covered:-0} pixels with hair"; exit 1; }
colours=$(tail -c +16 "$work/minimal.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l)
[ "$colours" -gt 200 ] || { echo "only $colours colours"; exit 1; }

# A file instead, and one that is not there.
if "$program" "$work/none.tfx" "$work/none.ppm" 2>"$work/none.log"; then
  echo "a missing strand file is not noticed"
  exit 1
fi
grep -q 'none.tfx' "$work/none.log" || { echo "the message does not name the file:"; cat "$work/none.log"; exit 1; }
