#!/usr/bin/env bash
# Path-traced references of several scenes (references.txt), with the variance of every pixel's luminance.
#   tests/golden/references.sh make [name]     renders them into references/: minutes each. Made once; again only if a
#                                              scene or the light transport changes
#   tests/golden/references.sh check [name]    renders with the irradiance cache and holds the result against them
# SPP is the number of samples per pixel of `make` (4096). BUILD is the build folder, if it is not `build`.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
out=$build/golden/references
aleph=$build/aleph
common=(--size 72x54 --bounces 1 -q)
traced=(--filter box --integrator path --spp "${SPP:-4096}" --seed 7)
cached=(--filter box --integrator cache --guide none --accuracy .1 --gather 256 --spp 16)

# Renders $1 (scene) with the options of the table ($2) and the others into $out/NAME.exr.
render() {
  local name=$1 scene=$2 options=$3 channels=$4 words kept
  shift 4
  read -ra words <<<"$options"
  read -ra kept <<<"$channels"
  (cd "$root" && "$aleph" render "$scene" "${words[@]}" "${common[@]}" "$@" -o "$out/full.exr")
  "$build/select_channels" "$out/full.exr" "$out/$name.exr" "${kept[@]}"
  rm -f "$out/full.exr"
}

check() {
  local name=$1 limits=$2 code=0 words
  read -ra words <<<"$limits"
  "$aleph" compare "$out/$name.exr" "$here/references/$name.exr" --channels R,G,B --standard-errors 4 --tolerance 0.01 \
    --relative 0.1 "${words[@]}" --diff "$out/$name.diff.png" >"$out/$name.txt" || code=$?
  if [ "$code" = 0 ]; then
    printf '%-14s within its limits: %s\n' "$name" "$(grep '^  luminance' "$out/$name.txt" | sed 's/^ *luminance *//')"
  else
    printf '%-14s BEYOND its limits (%s):\n' "$name" "$limits"
    cat "$out/$name.txt"
  fi
  return "$code"
}

action=${1:-}
only=${2:-}
case $action in
  make | check) ;;
  *) sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
esac
for program in aleph select_channels; do
  [ -x "$build/$program" ] || { echo "references.sh: $build/$program is not built" >&2; exit 1; }
done
mkdir -p "$out" "$here/references"

code=0
known=
while IFS='|' read -r name scene options limits; do
  case $name in '#'* | '') continue ;; esac
  read -r name <<<"$name"
  read -r scene <<<"$scene"
  [ -z "$only" ] || [ "$only" = "$name" ] || continue
  known=yes
  if [ "$action" = make ]; then
    render "$name" "$scene" "$options" "R G B variance.Y" "${traced[@]}" </dev/null
    cp "$out/$name.exr" "$here/references/$name.exr"
    echo "made references/$name.exr"
  elif [ -e "$here/references/$name.exr" ]; then
    render "$name" "$scene" "$options" "R G B" "${cached[@]}" </dev/null
    check "$name" "$limits" || code=1
  else
    printf '%-14s no reference yet: tests/golden/references.sh make %s\n' "$name" "$name"
    code=1
  fi
done <"$here/references.txt"
[ -n "$known" ] || { echo "references.sh: there is no reference '$only'" >&2; exit 2; }
exit "$code"
