#!/usr/bin/env bash
# Runs the study pool.json and makes report.jpg, a picture of its page. Takes a few minutes.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
cd "$root"
bash scenes/setup.sh chromium
cmake -S . -B build -G Ninja >/dev/null
ninja -C build --quiet aleph
build/aleph study scenes/studies/pool.json -o build/study-pool
bash render/report/picture.sh build build/study-pool/report.html "$here/report.jpg"
