#!/bin/sh
# Public headers compile alone and twice, in strict C99 and C++17: check_headers.sh INCLUDE_FOLDER VULKAN_INCLUDE CC CXX
set -eu
include=$1
vulkan=$2
c_compiler=$3
cxx_compiler=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Vulkan's own headers are not held to our warnings.
flags="-Wall -Wextra -Wpedantic -Werror -Wshadow -Wundef -I$include -isystem $vulkan -fsyntax-only"

compile() {  # compile LABEL compiler options...
  label=$1
  shift
  "$@" || { echo "failed: $label: $*"; exit 1; }
  echo "ok: $label"
}

for header in "$include"/forelock/*.h; do
  name=forelock/$(basename "$header")
  printf '#include "%s"\nint forelock_used;\n' "$name" >"$work/once.c"
  printf '#include "%s"\n#include "%s"\nint forelock_used;\n' "$name" "$name" >"$work/twice.c"
  for file in once twice; do
    cp "$work/$file.c" "$work/$file.cpp"
    # shellcheck disable=SC2086  # the flags are several words
    {
      compile "$name, $file, C99" "$c_compiler" -std=c99 -Wstrict-prototypes $flags "$work/$file.c"
      compile "$name, $file, C99, no Vulkan prototypes" "$c_compiler" -std=c99 -DVK_NO_PROTOTYPES $flags "$work/$file.c"
      compile "$name, $file, C++17" "$cxx_compiler" -std=c++17 $flags "$work/$file.cpp"
    }
  done
  # C99 has no bool of its own, and enums have no fixed size: neither belongs in an interface.
  if grep -n -w 'bool\|_Bool' "$header"; then echo "bool in $name"; exit 1; fi
done
for header in "$include"/forelock/*.hpp; do
  name=forelock/$(basename "$header")
  printf '#include "%s"\n#include "%s"\n' "$name" "$name" >"$work/twice.cpp"
  for standard in c++17 c++20; do
    # shellcheck disable=SC2086
    compile "$name, twice, $standard" "$cxx_compiler" -std=$standard -fno-exceptions -fno-rtti -Wnon-virtual-dtor $flags "$work/twice.cpp"
  done
done
