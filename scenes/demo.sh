#!/usr/bin/env bash
# The whole renderer in one command: set-up, build, four frames of `pool`, with samples spread evenly and by what a viewer sees, a table, pictures and a page.
set -euo pipefail
cd "$(dirname "$0")/.."
bash scenes/setup.sh
# A folder that was configured before keeps its options; a new one builds what it is asked for in any case.
[ -f build/build.ninja ] || cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DALEPH_PRECOMPILE=ON >/dev/null
ninja -C build --quiet aleph
build/aleph study scenes/studies/demo.json -o build/demo --errors "32 samples everywhere" --errors "error 1"
build/aleph maps scenes/pool/scene.json --frames 60 --size 240x180 -q -o build/demo/maps.png
echo "Pictures: build/demo/errors.jpg, build/demo/maps.png; a page to open: build/demo/report.html"
