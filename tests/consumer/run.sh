#!/usr/bin/env bash
# Installs the build in BUILD (build/) into a folder and moves that folder, because a package must not depend on where it
# was made. Then builds the program of this folder with the package and runs it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
work=$build/consumer
rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$work/made" >"$work/install.log"
mv "$work/made" "$work/moved"
cmake -S "$here" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/moved" >"$work/configure.log" ||
  { cat "$work/configure.log"; exit 1; }
cmake --build "$work/build" --parallel "${JOBS:-2}"
(cd "$work" && build/consumer)
"$work/moved/bin/aleph" --version

# PNG files are written by a library beside the program, and nothing is left where that is missing. EXR files do without it.
tiny() { "$work/moved/bin/aleph" render "$root/scenes/cornell/scene.json" --frames 0 --size 8x6 --spp 1 -o "$work/$1" -q; }
tiny with.png
library=$(find "$work/moved" -path "*/aleph/libaleph_images.so" -not -path "*python*")
mv "$library" "$work/away.so"
! tiny without.png 2>"$work/missing.log" || { echo "a PNG file without its library"; exit 1; }
grep -q "PNG, JPEG and HDR files need libaleph_images.so: it is not in .*: copy it to one of them" "$work/missing.log"
[ ! -e "$work/without.png" ]
tiny without.exr
mv "$work/away.so" "$library"

# The example of golden images: the same frames pass, and those with another seed and one sample fail.
aleph=$work/moved/bin/aleph scene=$root/scenes/cornell/scene.json quick="--size;32x24;--spp;4"
"$aleph" render "$scene" --frames 0-1 ${quick//;/ } -o "$work/golden/" -q
"$aleph" maps "$scene" --frames 0-1 --size 32x24 -o "$work/golden/maps/" -q
golden() {
  cmake -S "$here/golden" -B "$work/$1" -DALEPH="$aleph" -DSCENE="$scene" -DGOLDEN="$work/golden" -DSETTINGS="$2" >/dev/null
  ctest --test-dir "$work/$1" >"$work/$1.log" 2>&1
}
golden same "$quick" || { cat "$work/same.log"; exit 1; }
grep -q 'tests="2" failures="0"' "$work/same/results.xml"
! golden other "--size;32x24;--spp;1;--seed;9" || { echo "noise was not seen"; exit 1; }
grep -q '<failure message="' "$work/other/results.xml"

# The same with pytest.
python=python3
"$python" -c "import pytest" 2>/dev/null || python=/usr/bin/python3
pytest() {
  ALEPH=$aleph SCENE=$scene GOLDEN=$work/golden SETTINGS=$1 "$python" -m pytest -q -p no:cacheprovider "$here/golden/test_golden.py" \
    >"$work/pytest.log" 2>&1
}
pytest "${quick//;/ }" || { cat "$work/pytest.log"; exit 1; }
! pytest "--size 32x24 --spp 1 --seed 9" || { echo "noise was not seen by pytest"; exit 1; }
grep -q "2 failed" "$work/pytest.log"
