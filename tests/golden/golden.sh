#!/usr/bin/env bash
# Golden images: small pictures of several scenes (images.txt), equal in every value. A change must be reviewed.
#   tests/golden/golden.sh check [name]     renders them into build/golden and compares them with the references here;
#                                           then checks the cache against path-traced pictures (references.sh)
#   tests/golden/golden.sh review [name]    draws the images of the last check: new, reference, difference of each
#                                           layer that differs; with the numbers beside them
#   tests/golden/golden.sh accept [name]    checks, then makes the new pictures the references
# BUILD is the build folder, if it is not `build`.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
out=$build/golden
aleph=$build/aleph

usage() {
  sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 2
}

# The number under a key of one block of `aleph compare --json`: number FILE BLOCK KEY
number() {
  awk -v block="\"$2\":" -v key="\"$3\":" '
    $1 == block { inside = 1 }
    inside && $1 == key { if ($2 ~ /null/) print "infinite"; else printf "%.4g\n", $2; exit }' "$1"
}

# Renders into $out/NAME.exr. Images of the same scene and options are rendered once.
render() {
  local name=$1 scene=$2 options=$3 channels=$4 full words kept
  full=$out/full.$(printf %s "$scene $options" | tr -c 'a-z0-9\n' _).exr
  if [ ! -e "$full" ]; then
    read -ra words <<<"$options"
    (cd "$root" && "$aleph" "${words[0]}" "$scene" "${words[@]:1}" -q -o "$full")
  fi
  read -ra kept <<<"$channels"
  "$build/select_channels" "$full" "$out/$name.exr" "${kept[@]}"
}

# Compares $out/NAME.exr with the reference and prints one row. Fails if they differ.
compare() {
  local name=$1 code=0
  if [ ! -e "$here/$name.exr" ]; then
    printf '%-14s %s\n' "$name" "new: no reference yet"
    return 1
  fi
  "$aleph" compare "$out/$name.exr" "$here/$name.exr" --json >"$out/$name.json" || code=$?
  if [ "$code" -ge 2 ]; then
    printf '%-14s %s\n' "$name" "not comparable: see above"
    return 1
  fi
  local verdict=same
  [ "$code" = 0 ] || verdict=DIFFERENT
  printf '%-14s %-10s %10s %10s %13s %10s\n' "$name" "$verdict" "$(number "$out/$name.json" all max)" \
    "$(number "$out/$name.json" all rms)" "$(number "$out/$name.json" all relative_mse)" \
    "$(number "$out/$name.json" beyond percent)"
  return "$code"
}

# Draws $out/NAME.review.png: new and reference, where they are colours, and the difference of every layer that differs; and
# writes the numbers to $out/NAME.txt: draw NAME LAYER...
draw() {
  local name=$1 new=$out/$1.exr reference=$here/$1.exr layer picture panels=()
  shift
  if [ "$1" = R ]; then
    panels=("new=$new")
    [ ! -e "$reference" ] || panels+=("reference=$reference")
    set -- R,G,B
  fi
  if [ -e "$reference" ]; then
    "$aleph" compare "$new" "$reference" >"$out/$name.txt" 2>&1 || true
    for layer; do
      picture=$out/$name.${layer//,/}.png
      ! "$aleph" compare "$new" "$reference" --channels "$layer" --diff "$picture" >/dev/null 2>&1 || continue
      [ ! -e "$picture" ] || panels+=("difference of ${layer//,/}; white: the largest=$picture")
    done
  fi
  [ ${#panels[@]} = 0 ] || "$build/study_sheet" "${panels[@]}" -o "$out/$name.review.png" --columns 3 --width 420
  ls "$out/$name".review.png "$out/$name".txt 2>/dev/null || true
}

action=${1:-}
only=${2:-}
case $action in check | review | accept) ;; *) usage ;; esac
[ $# -le 2 ] || usage
for program in aleph select_channels study_sheet; do
  [ -x "$build/$program" ] || { echo "golden.sh: $build/$program is not built" >&2; exit 1; }
done

mkdir -p "$out"
if [ "$action" != review ]; then
  rm -f "$out"/*.exr "$out"/*.json "$out"/*.png "$out"/*.txt
  printf '%-14s %-10s %10s %10s %13s %10s\n' image verdict max RMS 'relative MSE' 'beyond, %'
fi
count=0
differing=()
while IFS='|' read -r name scene options channels; do
  case $name in '#'* | '') continue ;; esac
  read -r name <<<"$name"
  read -r scene <<<"$scene"
  [ -z "$only" ] || [ "$only" = "$name" ] || continue
  if [ "$action" != review ]; then
    render "$name" "$scene" "$options" "$channels" </dev/null
    compare "$name" || differing+=("$name $channels")
  elif [ -e "$out/$name.exr" ]; then
    # shellcheck disable=SC2086  # names of layers
    draw "$name" $channels
  fi
  if [ "$action" = accept ]; then cp "$out/$name.exr" "$here/$name.exr"; fi
  [ ! -e "$out/$name.exr" ] || count=$((count + 1))
done <"$here/images.txt"
[ "$count" -gt 0 ] || { echo "golden.sh: there is no image '$only', or none is rendered yet" >&2; exit 2; }

[ "$action" != review ] || exit 0
if [ "$action" = accept ]; then
  echo "Accepted. Commit tests/golden/*.exr with the reason for the change."
  exit
fi
code=0
if [ ${#differing[@]} -gt 0 ]; then
  # shellcheck disable=SC2086  # a name, and names of layers
  for image in "${differing[@]}"; do draw $image; done >&2
  echo "Look at these. If the change is right: tests/golden/golden.sh accept" >&2
  code=1
fi
if [ -z "$only" ] && compgen -G "$here/references/*.exr" >/dev/null; then
  bash "$here/references.sh" check || code=1
fi
exit "$code"
