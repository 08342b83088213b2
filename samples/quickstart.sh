#!/bin/sh
# From a fresh machine to a picture of hair: sh samples/quickstart.sh
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install=1
for argument in "$@"; do
  case $argument in
    --no-install) install=0 ;;
    -h | --help)
      cat <<'TEXT'
usage: sh samples/quickstart.sh [--no-install]

Installs the Debian packages that are missing (with sudo when you are not root), builds Forelock (Release) into build/,
and renders the default groom to build/quickstart.png on the best Vulkan device there is; without a GPU that is Mesa's
lavapipe, on the processor. A second run installs and rebuilds nothing.

  --no-install   install nothing; fails later if something is missing
TEXT
      exit 0 ;;
    *) fail "unknown argument '$argument'; see --help" ;;
  esac
done

[ $install = 0 ] || installPackages build
say "building into build/"
configure build -DCMAKE_BUILD_TYPE=Release
build build forelock forelock_shared forelock_minimal

say "rendering the groom long-wavy"
build/forelock preview groom:long-wavy -o build/quickstart.png

cat <<'TEXT'

The picture is build/quickstart.png. What to try next:
  build/forelock preview FILE -o out.png                   your own hair (.tfx, .hair); --help: colour, light, camera, method
  build/forelock preview groom:long-wavy -o out.png --hair-color c9a26b --azimuth 200
  build/forelock preview groom:long-wavy -o out.png --color layers     how many fragments a pixel has
  build/forelock preview groom:long-wavy -o out.png --turntable 6 --size 512x512
  build/forelock view groom:long-wavy                      a window: turn it, light it, compare methods, see what they cost
  build/forelock inspect FILE                              what is in a strand file, and what is wrong with it
  build/forelock plan groom:long-wavy                      the passes and bytes that a frame needs, and what is left out
  build/forelock_minimal                                   a host engine in one C file: samples/minimal/minimal.c
  sh tests/run.sh                                          the tests
Scenes, grooms and methods are explained in docs/scene.md, docs/grooms.md and docs/methods.md.
TEXT
