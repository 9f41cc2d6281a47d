#!/bin/sh
# run.sh BUILD [ASSETS]: does Khronos' glTF-Validator agree with `aleph explain` on what is valid? Looks at the glTF files
# below ASSETS, at BUILD/round_trip (test_gltf_round_trip writes there) and at BUILD/gltf_corpus, if there is one.
# Ends with 0 (agreed), 1 (not), or 77 (skipped, said why).
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd) || exit 1
assets=${2:-$here/../../../shared/assets/gltf}
for tool in node npm; do
  if ! command -v $tool >/dev/null; then
    echo "skipped: $tool is not installed (scenes/setup.sh can)"
    exit 77
  fi
done
modules=$build/gltf_validator
mkdir -p "$modules" || exit 1
if ! cmp -s "$here/package-lock.json" "$modules/package-lock.json" || [ ! -f "$modules/installed" ]; then
  rm -f "$modules/installed"
  cp "$here/package.json" "$here/package-lock.json" "$modules/" || exit 1
  if ! (cd "$modules" && npm ci --no-audit --no-fund >npm.log 2>&1); then
    echo "skipped: npm could not install gltf-validator (no network?); $modules/npm.log says more"
    exit 77
  fi
  : >"$modules/installed"
fi
IFS='
'  # names may hold blanks
set --
for folder in "$assets" "$build/round_trip" "$build/gltf_corpus"; do
  [ -d "$folder" ] || continue
  for file in $(cd "$folder" && find . -name '*.gltf' -o -name '*.glb' | sort); do
    set -- "$@" "$folder/${file#./}"
  done
done
if [ $# -eq 0 ]; then
  echo "skipped: there are no glTF files in $assets or $build"
  exit 77
fi
cd "$modules" && exec node "$here/validate.mjs" "$build/aleph" "$@"
