#!/usr/bin/env bash
# Builds the fuzz targets with clang's libFuzzer, AddressSanitizer and UBSan into build-fuzz/ and lets each run.
#   tests/fuzz/run.sh [SECONDS] [READER...]     60 seconds each of gltf, scene_file, alembic, image
# A report ends the run; the input that caused it is then in build-fuzz/found/.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build-fuzz
seconds=${1:-60}
shift || true
readers=("$@")
[ ${#readers[@]} -gt 0 ] || readers=(gltf scene_file alembic image)

bash "$root/scenes/setup.sh" clang libclang-rt-14-dev
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DALEPH_FUZZ=ON -DALEPH_TESTS=OFF \
  -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O1 -g1" >"$build.log" || { cat "$build.log"; exit 1; }
rm -f "$build.log"
cmake --build "$build" --parallel "${JOBS:-2}" --target "${readers[@]/#/fuzz_}"

# Real files to start from; what is found new stays in build-fuzz/corpus for the next run.
seeds=$build/seeds
rm -rf "$seeds"
mkdir -p "$build/found" "$seeds"/{gltf,scene_file,alembic,image} "$build"/corpus/{gltf,scene_file,alembic,image}
cp "$root"/scenes/room/*.glb "$root"/tests/assets/gltf/*.gl* "$seeds/gltf/"
cp "$root"/scenes/hard/*.json "$root"/scenes/furnace/*.json "$seeds/scene_file/"
cp "$root/scenes/cornell/scene.json" "$seeds/scene_file/cornell.json"
cp "$root"/tests/assets/abc/*.abc "$seeds/alembic/"
cp "$root"/scenes/pool/textures/b*.png "$root"/tests/golden/*.exr "$seeds/image/"
printf '#?RADIANCE\nEXPOSURE=2\nCOLORCORR= 1 2 .5\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n%016d' 0 >"$seeds/image/small.hdr"
assets=$root/../shared/assets
if [ -d "$assets" ]; then
  find "$assets/gltf" \( -name '*.glb' -o -name '*.gltf' \) -size -200k -exec cp {} "$seeds/gltf/" \;
  find "$assets/abc" -name '*.abc' -exec cp {} "$seeds/alembic/" \;
fi
# Leaks are not looked for: that needs ptrace, which containers refuse.
export ASAN_OPTIONS=detect_leaks=0
for reader in "${readers[@]}"; do
  echo "== $reader, $seconds s"
  "$build/fuzz_$reader" "$build/corpus/$reader" "$seeds/$reader" -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=2048 -max_len=65536 -artifact_prefix="$build/found/$reader-" -print_final_stats=1 2>&1 |
    grep -E "^==|ERROR|SUMMARY|runtime error|stat::number_of_executed|DONE|Test unit|deadly" | tail -12
  [ "${PIPESTATUS[0]}" = 0 ] || { echo "$reader: a report; its input is in build-fuzz/found/" >&2; exit 1; }
done
