#!/bin/sh
# What the shared library shows and needs: check_exports.sh LIBFORELOCK.SO INCLUDE_FOLDER
set -eu
library=$1
include=$2

symbols=$(nm -D --defined-only "$library" | awk '{ print $NF }' | sed 's/@.*//' | sort -u)
foreign=$(printf '%s\n' "$symbols" | grep -v '^flk[A-Z]' || true)
if [ -n "$foreign" ]; then
  echo "exported, but not of the API:"
  printf '%s\n' "$foreign" | c++filt | head -n 40
  exit 1
fi

# Everything the headers declare is there, and nothing more.
declared=$(sed -n 's/^FLK_API .*[ *]\(flk[A-Za-z0-9]*\)(.*/\1/p' "$include"/forelock/*.h | sort -u)
if [ "$declared" != "$symbols" ]; then
  echo "declared and not exported, or exported and not declared:"
  for name in $declared $symbols; do echo "$name"; done | sort | uniq -u
  exit 1
fi

needed=$(objdump -p "$library" | awk '$1 == "NEEDED" { print $2 }')
extra=$(printf '%s\n' "$needed" | grep -v -E '^(libstdc\+\+|libm|libgcc_s|libc|ld-linux[-a-z0-9_]*|libasan|libubsan|libtsan)\.so' || true)
if [ -n "$extra" ]; then
  echo "needs more than the C++ runtime: $extra"
  exit 1
fi

# Vulkan is reached through the host only.
if nm -D --undefined-only "$library" | grep -E ' vk[A-Z]'; then
  echo "links Vulkan functions"
  exit 1
fi
# Every byte of host memory goes through the host's callbacks: nothing calls operator new.
if nm -D --undefined-only "$library" | grep -E ' _Zn[wa]'; then
  echo "allocates past the host's callbacks"
  exit 1
fi
# Writes to no console and ends no program.
if nm -D --undefined-only "$library" | grep -E -w '(printf|puts|putchar|perror|abort|exit|_exit|quick_exit)(@.*)?$'; then
  echo "prints or exits"
  exit 1
fi
echo "$(printf '%s\n' "$symbols" | wc -l) functions; needs" "$(printf '%s ' $needed)"
