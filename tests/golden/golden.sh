#!/usr/bin/env bash
# Golden images: small pictures of several scenes (images.txt), equal in every value. A change must be reviewed.
#   tests/golden/golden.sh check [name]     renders them into build/golden and compares them with the references here;
#                                           then checks the cache against path-traced pictures (references.sh)
#   tests/golden/golden.sh review [name]    prints a page of the last check: new, reference, difference, numbers
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
  sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 2
}

trim() {
  local text=$1
  text=${text#"${text%%[![:space:]]*}"}
  printf %s "${text%"${text##*[![:space:]]}"}"
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
  "$aleph" compare "$out/$name.exr" "$here/$name.exr" --json --diff "$out/$name.diff.png" >"$out/$name.json" || code=$?
  if [ "$code" -ge 2 ]; then
    printf '%-14s %s\n' "$name" "not comparable: see above"
    return 1
  fi
  local verdict=same
  [ "$code" = 0 ] || verdict=DIFFERENT
  printf '%-14s %-10s %10s %10s %13s %10s\n' "$name" "$verdict" "$(number "$out/$name.json" all max)" \
    "$(number "$out/$name.json" all rms)" "$(number "$out/$name.json" all relative_mse)" \
    "$(number "$out/$name.json" beyond percent)"
  [ "$code" != 0 ] || rm -f "$out/$name.diff.png"
  return "$code"
}

# One page of the named images.
write_page() {
  "$build/golden_page" "$out/review.html" "$out" "$here" "$@"
  echo "$out/review.html"
}

action=${1:-}
only=${2:-}
case $action in check | review | accept) ;; *) usage ;; esac
for program in aleph select_channels golden_page; do
  [ -x "$build/$program" ] || { echo "golden.sh: $build/$program is not built" >&2; exit 1; }
done

images=()
while IFS= read -r line; do
  case $line in '#'* | '') continue ;; esac
  [ -z "$only" ] || [ "$only" = "$(trim "${line%%|*}")" ] || continue
  images+=("$line")
done <"$here/images.txt"
[ ${#images[@]} -gt 0 ] || { echo "golden.sh: there is no image '$only'" >&2; exit 2; }

if [ "$action" = review ]; then
  names=()
  for image in "${images[@]}"; do
    name=$(trim "${image%%|*}")
    [ ! -e "$out/$name.exr" ] || names+=("$name")
  done
  [ ${#names[@]} -gt 0 ] || { echo "golden.sh: nothing to review; run golden.sh check first" >&2; exit 1; }
  write_page "${names[@]}"
  exit
fi

mkdir -p "$out"
rm -f "$out"/*.exr "$out"/*.json "$out"/*.png "$out"/*.html
differing=()
printf '%-14s %-10s %10s %10s %13s %10s\n' image verdict max RMS 'relative MSE' 'beyond, %'
for image in "${images[@]}"; do
  IFS='|' read -r name scene options channels <<<"$image"
  name=$(trim "$name")
  render "$name" "$(trim "$scene")" "$options" "$channels"
  compare "$name" || differing+=("$name")
  if [ "$action" = accept ]; then cp "$out/$name.exr" "$here/$name.exr"; fi
done

if [ "$action" = accept ]; then
  echo "Accepted. Commit tests/golden/*.exr with the reason for the change."
  exit
fi
code=0
if [ ${#differing[@]} -gt 0 ]; then
  printf 'Look at %s\nIf the change is right: tests/golden/golden.sh accept\n' "$(write_page "${differing[@]}")" >&2
  code=1
fi
if [ -z "$only" ] && compgen -G "$here/references/*.exr" >/dev/null; then
  bash "$here/references.sh" check || code=1
fi
exit "$code"
