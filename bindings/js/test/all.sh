#!/usr/bin/env bash
# Does the package work as others get it? Packs it, installs the archive into a fresh folder, and runs the tests with that.
#   all.sh WORK_DIR CASES MORE FRAMES: the files of c_dump_cases, and that of c_dump_frames
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
work="$(readlink -f "$1")" cases="$(readlink -f "$2")" more="$(readlink -f "$3")" frames="$(readlink -f "$4")"

# What a page waits for: plans, histories and errors; with all other calls.
for module in gnomon:130000 gnomon-scalar:130000 gnomon-full:187000 gnomon-full-scalar:187000; do
  limit="${module#*:}" module="${module%:*}"
  bytes="$(brotli -q 11 -c "$here/../$module.wasm" | wc -c)"
  echo "$module.wasm: $(stat -c %s "$here/../$module.wasm") bytes, $bytes with brotli"
  ((bytes <= limit)) || { echo "$module.wasm: more than $limit bytes with brotli" >&2; exit 1; }
done

rm -rf "$work/consumer"
mkdir -p "$work/consumer"
archive="$(cd "$here/.." && npm pack --silent --pack-destination "$work/consumer")"
cd "$work/consumer"
echo '{"name": "consumer", "private": true, "type": "module"}' >package.json
npm install --silent --no-audit --no-fund "./$archive" typescript@5 three@0.187 @types/three three-mesh-bvh@0.9 puppeteer-core@24 @babylonjs/core@9.35 playcanvas@2.23
export MODULE="$work/consumer/node_modules/gnomon/index.js" CASES="$cases" MORE="$more" FRAMES="$frames" CONSUMER="$work/consumer"
node --test "$here"/*.test.js
# The types hold what the manual shows. Those of Babylon and PlayCanvas declare what others declare as well: they are not checked themselves.
cp "$here"/types*.ts .
npx tsc --noEmit --strict --target es2022 --lib es2022,dom --module nodenext types.ts
npx tsc --noEmit --strict --skipLibCheck --target es2022 --lib es2022,dom --module nodenext types_babylon.ts types_playcanvas.ts
