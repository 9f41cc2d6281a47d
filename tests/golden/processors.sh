#!/usr/bin/env bash
# The golden images as other processors render them: the files must have the same bytes.
#   tests/golden/processors.sh [name]
# Each image is rendered with every instruction set that Embree can be held to (ALEPH_ISA), the oldest of them with the C
# library kept from everything newer than AVX2 and FMA. Two small pictures are rendered by an emulated Haswell (qemu-user):
# little is emulated but the start of the program, textures, and one sample a pixel. Every file is of a run of its own, so
# that nothing may depend on addresses or time either (DT-10).
# BUILD is the build folder, if it is not `build`.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
out=$build/golden/processors
aleph=$build/aleph
only=${1:-}
[ -x "$aleph" ] || { echo "processors.sh: $aleph is not built" >&2; exit 1; }

flags=$(grep -m1 '^flags' /proc/cpuinfo 2>/dev/null || true)
sets=(avx avx2)
# Without ALEPH_ISA Embree takes the best that there is.
if [[ $flags != *avx512vl* ]]; then unset 'sets[1]'; fi
newer=-AVX512F,-AVX512VL,-AVX512BW,-AVX512DQ,-AVX512CD,-AVX512_VNNI,-AVX_VNNI,-AMX_TILE,-ERMS,-FSRM,-Prefer_No_VZEROUPPER

rm -rf "$out"
mkdir -p "$out"
cd "$root"
different=()
compared=0
# same NAME VARIANT: whether its file equals the one that was rendered first.
same() {
  compared=$((compared + 1))
  cmp -s "$out/$1.exr" "$out/$1.$2.exr" && return
  echo "$1: other bytes with $2: $out/$1.$2.exr" >&2
  different+=("$1 $2")
}

while IFS='|' read -r name scene options _; do
  case $name in '#'* | '') continue ;; esac
  read -r name <<<"$name"
  read -r scene <<<"$scene"
  [ -z "$only" ] || [ "$only" = "$name" ] || continue
  read -ra words <<<"$options"
  render() { "$aleph" "${words[0]}" "$scene" "${words[@]:1}" -q -o "$1"; }
  render "$out/$name.exr"
  for kernels in "${sets[@]}"; do
    ALEPH_ISA=$kernels render "$out/$name.$kernels.exr"
    same "$name" "$kernels"
  done
  ALEPH_ISA=sse4.2 GLIBC_TUNABLES=glibc.cpu.hwcaps=$newer render "$out/$name.old.exr"
  same "$name" old
done <"$here/images.txt"

if [ -z "$only" ]; then
  if command -v qemu-x86_64 >/dev/null 2>&1; then
    emulate() {
      "$aleph" "${@:2}" -t 1 -q -o "$out/$1.exr"
      qemu-x86_64 -cpu Haswell "$aleph" "${@:2}" -t 1 -q -o "$out/$1.haswell.exr" 2>"$out/qemu.txt" || cat "$out/qemu.txt" >&2
      same "$1" haswell
    }
    quick=(--spp 1 --gather 16 --accuracy .5 --light-step 0 --motion flow --aovs)
    emulate emulated render tests/golden/blur.json --frames 1 --size 32x24 "${quick[@]}"
    emulate emulated-textures render scenes/materials/brick_wall.json --frames 0 --size 24x18 "${quick[@]}"
  else
    echo "qemu-x86_64 is not installed: nothing was emulated"
  fi
fi
[ "$compared" -gt 0 ] || { echo "processors.sh: no image is called $only" >&2; exit 2; }
[ ${#different[@]} -eq 0 ] || { echo "${#different[@]} of $compared pictures differ"; exit 1; }
echo "$compared pictures have the bytes of this processor's own"
