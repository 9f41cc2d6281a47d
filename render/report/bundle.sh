#!/usr/bin/env bash
# bundle.sh FOLDER REPORT VIEWER [skip]: bundles the report page and the viewer test of studies into these two files of one
# folder. FOLDER keeps the packages from npm. The build calls it. Without npm, without a network for the first time, or with
# `skip`, both are empty: `aleph study` then writes everything but the pages.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$1
out=$2
viewer=$3
mkdir -p "$folder" "$(dirname "$out")" "$(dirname "$viewer")"
folder=$(cd "$folder" && pwd)
out=$(realpath "$out")
viewer=$(realpath "$viewer")

without() {
  : >"$out"
  : >"$viewer"
  echo "aleph study will write no page: $1"
  exit 0
}

[ "${4:-}" != skip ] || { : >"$out"; : >"$viewer"; exit 0; }
for tool in node npm; do
  command -v "$tool" >/dev/null || without "$tool is not installed; scenes/setup.sh can install it"
done
if ! cmp -s "$here/package-lock.json" "$folder/package-lock.json" || [ ! -f "$folder/installed" ]; then
  rm -f "$folder/installed"
  cp "$here/package.json" "$here/package-lock.json" "$folder/"
  (cd "$folder" && npm ci --no-audit --no-fund >npm.log 2>&1) ||
    without "npm could not install its packages, perhaps for want of a network (see $folder/npm.log)"
  : >"$folder/installed"
fi
(cd "$folder" && node "$here/build.mjs" "$out" >bundle.log 2>&1) || without "bundling failed (see $folder/bundle.log)"
