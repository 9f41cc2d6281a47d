#!/usr/bin/env bash
# The whole renderer in one command: set-up, build, frames of `pool` with and without guidance, a table and a picture.
set -euo pipefail
cd "$(dirname "$0")/.."
bash scenes/setup.sh
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DALEPH_PRECOMPILE=ON >/dev/null
ninja -C build --quiet aleph study_demo
mkdir -p build/demo
build/study_demo scenes/pool/scene.json --frames 20,60 -o build/demo/demo.png
