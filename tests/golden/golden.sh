#!/usr/bin/env bash
# Golden images: small pictures of scenes/pool. A change of one of them must be reviewed.
#   tests/golden/golden.sh check [name]    renders them into build/golden and compares them with the references here
#   tests/golden/golden.sh accept [name]   the same, then makes them the references
# If they differ, build/golden/NAME.exr is the new picture and NAME.diff.png shows the differences (white: the largest).
# BUILD is the build folder, if it is not `build`.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
out=$build/golden
aleph=$build/aleph

usage() {
  sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 2
}

# name | layers and channels kept in the reference | tolerance | command.
# Motion and maps have no noise: processors differ in the last bits only, and in which of two surfaces a ray along
# their common edge meets. Gathering takes other paths after such a bit, so the frame has more room.
images=(
  "motion|forward motion velocity|--tolerance 1e-4 --relative 1e-5 --share 0.1|maps"
  "aleph|aleph saliency threshold|--tolerance 1e-4 --relative 1e-4 --share 0.1|maps"
  "frame|R G B|--relative 1e-4 --share 1|render --spp 1 --gather 64 --accuracy .3"
)
common=(scenes/pool/scene.json --frames 12 --size 160x120 -q)

# The number under a key of one block of `aleph compare --json`: number FILE BLOCK KEY
number() {
  awk -v block="\"$2\":" -v key="\"$3\":" '
    $1 == block { inside = 1 }
    inside && $1 == key { if ($2 ~ /null/) print "infinite"; else printf "%.4g\n", $2; exit }' "$1"
}

# Renders into $out/NAME.exr. Images of the same command are rendered once.
render() {
  local name=$1 channels=$2 command=$3 full
  full=$out/full.$(printf %s "$command" | tr -c 'a-z0-9\n' _).exr
  if [ ! -e "$full" ]; then
    local words
    read -ra words <<<"$command"
    (cd "$root" && "$aleph" "${words[0]}" "${common[@]}" "${words[@]:1}" -o "$full")
  fi
  local kept
  read -ra kept <<<"$channels"
  "$build/select_channels" "$full" "$out/$name.exr" "${kept[@]}"
}

# Compares $out/NAME.exr with the reference and prints one row. Fails if they differ.
review() {
  local name=$1 tolerance=$2 code=0 limits
  if [ ! -e "$here/$name.exr" ]; then
    printf '%-8s %s\n' "$name" "new: no reference yet"
    return 1
  fi
  read -ra limits <<<"$tolerance"
  "$aleph" compare "$out/$name.exr" "$here/$name.exr" "${limits[@]}" --json --diff "$out/$name.diff.png" \
    >"$out/$name.json" || code=$?
  if [ "$code" -ge 2 ]; then
    printf '%-8s %s\n' "$name" "not comparable: see above"
    return 1
  fi
  local verdict=same
  [ "$code" = 0 ] || verdict=DIFFERENT
  printf '%-8s %-10s %12s %12s %12s %12s   %s\n' "$name" "$verdict" "$(number "$out/$name.json" all max)" \
    "$(number "$out/$name.json" all rms)" "$(number "$out/$name.json" all relative_mse)" \
    "$(number "$out/$name.json" beyond percent)" "$tolerance"
  [ "$code" != 0 ] || rm -f "$out/$name.diff.png"
  return "$code"
}

action=${1:-}
only=${2:-}
case $action in check | accept) ;; *) usage ;; esac
for program in aleph select_channels; do
  [ -x "$build/$program" ] || { echo "golden.sh: $build/$program is not built" >&2; exit 1; }
done
mkdir -p "$out"
rm -f "$out"/*.exr "$out"/*.json "$out"/*.png

differing=()
known=
printf '%-8s %-10s %12s %12s %12s %12s   %s\n' image verdict max RMS 'relative MSE' 'beyond, %' allowed
for image in "${images[@]}"; do
  IFS='|' read -r name channels tolerance command <<<"$image"
  [ -z "$only" ] || [ "$only" = "$name" ] || continue
  known=yes
  render "$name" "$channels" "$command"
  review "$name" "$tolerance" || differing+=("$name")
  if [ "$action" = accept ]; then cp "$out/$name.exr" "$here/$name.exr"; fi
done
[ -n "$known" ] || { echo "golden.sh: there is no image '$only'" >&2; exit 2; }

if [ "$action" = accept ]; then
  echo "Accepted. Commit tests/golden/*.exr with the reason for the change."
elif [ ${#differing[@]} -gt 0 ]; then
  echo "Look at $out/*.diff.png; if the change is right: tests/golden/golden.sh accept" >&2
  exit 1
fi
