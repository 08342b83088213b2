#!/bin/sh
# What the command exports as glTF, judged by the Khronos validator: sh tests/validate_gltf.sh
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

version=2.0.0-dev.3.10
case ${1-} in
  '') ;;
  -h | --help)
    cat <<TEXT
usage: sh tests/validate_gltf.sh

Builds build/forelock where it is not up to date, installs gltf-validator $version from npm into build/validator, writes
assets with every set of attributes as .glb and .gltf, and prints what the validator says of each. Exits with 0 if there is no error
and no warning. Installs nodejs and npm where they are missing.
TEXT
    exit 0 ;;
  *) fail "unknown argument '$1'; see --help" ;;
esac

if ! command -v node >/dev/null 2>&1 || ! command -v npm >/dev/null 2>&1; then installPackages validate; fi
configure build -DCMAKE_BUILD_TYPE=Release
build build forelock
tool=build/validator
mkdir -p "$tool"
[ -d "$tool/node_modules/gltf-validator" ] || npm install --silent --no-fund --no-audit --prefix "$tool" "gltf-validator@$version" >&2
out=$tool/files
rm -rf "$out"
mkdir -p "$out"

# Colours, masses and root UVs as well.
cat >"$out/all.ply" <<'PLY'
ply
format ascii 1.0
element vertex 5
property float x
property float y
property float z
property float thickness
property float inverse_mass
property uchar red
property uchar green
property uchar blue
element strand 2
property ushort nsegs
property float u
property float v
end_header
0 0 0 0.001 0 255 128 0
0 -0.1 0 0.0005 1 250 120 0
0.01 0 0 0.001 0 255 128 0
0.012 -0.06 0 0.0008 0 255 128 0
0.02 -0.1 0.01 0.0005 1 240 100 0
1 0.25 0.75
2 0.5 0.75
PLY
# Two groups, one of them moved.
cat >"$out/groups.json" <<'GLTF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "name": "left side"}, {"mesh": 0, "name": "right", "translation": [1, 0, 0]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 3}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}]}
GLTF

forelock=build/forelock
export FORELOCK_HAIRASSETS=hairassets
"$forelock" groom paper-load "$out/widths.glb" --strands 1000
"$forelock" groom paper-load "$out/long.glb" --strands 6000  # 32-bit indices
"$forelock" groom paper-load "$out/bare.tfx" --strands 100 2>/dev/null
"$forelock" convert "$out/bare.tfx" "$out/masses.glb"
"$forelock" convert "$out/bare.tfx" "$out/positions.hair" 2>/dev/null
"$forelock" convert "$out/positions.hair" "$out/positions.glb"
"$forelock" convert "$out/all.ply" "$out/all.glb"
"$forelock" convert "$out/groups.json" "$out/groups.glb"
for name in widths masses positions all groups; do "$forelock" convert "$out/$name.glb" "$out/$name again.gltf"; done

cat >"$tool/judge.js" <<'JS'
const fs = require('fs'), path = require('path'), validator = require('gltf-validator');
const names = ['errors', 'warnings', 'infos', 'hints'], totals = [0, 0, 0, 0];
(async () => {
  for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
      uri: path.basename(file), maxIssues: 0,
      externalResourceFunction: uri => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri))).then(data => new Uint8Array(data)),
    });
    const issues = report.issues, counts = [issues.numErrors, issues.numWarnings, issues.numInfos, issues.numHints];
    counts.forEach((count, i) => totals[i] += count);
    console.log(`${path.basename(file)}: ` + counts.map((count, i) => `${count} ${names[i]}`).join(', '));
    for (const issue of issues.messages) console.log(`  ${names[issue.severity].slice(0, -1)} ${issue.code} at ${issue.pointer}: ${issue.message}`);
  }
  console.log(`${process.argv.length - 2} files, validator ${validator.version()}: ` + totals.map((count, i) => `${count} ${names[i]}`).join(', '));
  process.exit(totals[0] + totals[1] > 0 ? 1 : 0);
})().catch(error => { console.error(error); process.exit(1); });
JS
node "$tool/judge.js" "$out"/*.glb "$out"/*.gltf
