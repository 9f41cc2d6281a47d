#!/usr/bin/env bash
# run.sh BUILD [ASSETS]: does Khronos' glTF-Validator agree with `aleph explain` on what is valid? Looks at tests/assets/gltf,
# at the glTF files below ASSETS, at BUILD/round_trip (test_gltf_round_trip writes there) and at BUILD/gltf_corpus, where
# they are there.
# Ends with 0 (agreed), 1 (not), or 77 (skipped, said why).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(cd "$1" && pwd)
assets=${2:-$here/../../../shared/assets/gltf}
source "$here/../results.sh"

skip() {
  echo "skipped: $1"
  record_skip "$build" gltf_validator "$1"
  exit 77
}

for tool in node npm; do
  command -v "$tool" >/dev/null || skip "$tool is not installed; scenes/setup.sh can"
done
modules=$build/gltf_validator
mkdir -p "$modules"
if ! cmp -s "$here/package-lock.json" "$modules/package-lock.json" || [ ! -f "$modules/installed" ]; then
  rm -f "$modules/installed"
  cp "$here/package.json" "$here/package-lock.json" "$modules/"
  (cd "$modules" && npm ci --no-audit --no-fund >npm.log 2>&1) ||
    skip "npm could not install gltf-validator, perhaps for want of a network; its log is in the build folder"
  : >"$modules/installed"
fi
files=()
for folder in "$here/../assets/gltf" "$assets" "$build/round_trip" "$build/gltf_corpus"; do
  [ -d "$folder" ] || continue
  mapfile -t found < <(find "$folder" -name '*.gltf' -o -name '*.glb' | sort)
  files+=("${found[@]}")
done
cd "$modules"
exec node "$here/validate.mjs" "$build/aleph" "${files[@]}"
