#!/usr/bin/env bash
# tests/blender/run.sh [BUILD]: exports the authored scenes, imports them in Blender, and compares transforms at 50 times.
# Run by hand, two minutes; needs Blender (bash scenes/setup.sh blender) and the Python module.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${1:-$root/build}
command -v blender >/dev/null || { echo "skipped: Blender is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
for scene in "$root"/scenes/*/scene.json "$root"/scenes/hard/*.json "$root"/scenes/effects/*.json; do
  [ "$(basename "$scene")" != ten_hours.json ] || continue  # float seconds of glTF do not tell its frames apart
  printf '%-40s ' "${scene#"$root"/scenes/}"
  "$build/aleph" export "$scene" --bake -q -o "$work/scene.glb" 2>"$work/log" ||
    { tail -1 "$work/log"; failures=$((failures + 1)); continue; }
  PYTHONPATH=$build/python blender -b --factory-startup --python-use-system-env --python-exit-code 1 \
    --python "$here/compare.py" -- "$scene" "$work/scene.glb" >"$work/log" 2>&1 || failures=$((failures + 1))
  grep '^compared' "$work/log" || tail -3 "$work/log"
done
exit $((failures > 0))
