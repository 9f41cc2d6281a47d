#!/usr/bin/env bash
# Runs the studies and benchmarks whose results README.md and THESIS.md have, in out/studies, and makes their pictures.
#   bash scenes/studies/report.sh [study ...]     pool takes minutes, all of them hours
#   bash scenes/studies/report.sh thesis          all of THESIS.md, with its figures
set -euo pipefail
cd "$(dirname "$0")/../.."
bash scenes/setup.sh chromium
cmake -S . -B build -G Ninja >/dev/null
ninja -C build --quiet aleph study_motion study_sheet

# study FILE NAME [OPTION ...]
study() {
  local file=scenes/studies/$1.json name=$2
  shift 2
  build/aleph study "$file" -o "out/studies/$name" "$@"
}

# room NAME OPTION ...: frame 32 of antique-room, larger than its study can be in the time, for figures 6.15 and 6.16.
room() {
  build/aleph render scenes/antique-room/scene.json --frames 32 --size 320x240 --accuracy .15 --gather 1024 --light-samples 1 --bounces 1 \
    --light-step 10 --aovs -q -o "out/studies/antique-room/$1.exr" "${@:2}"
}

# benchmark NAME: its tables alone, printed and in out/studies/NAME.txt.
benchmark() {
  ninja -C build --quiet "bench_$1"
  mkdir -p out/studies
  "build/bench_$1" | sed -n '/ one thread/,$p' | tee "out/studies/$1.txt"
}

run() {
  case $1 in
    demo)
      bash scenes/demo.sh
      cp build/demo/errors.jpg scenes/studies/demo.jpg ;;
    pool)
      study pool pool
      # In the folder that has the packages.
      (cd build/report && node ../../render/report/picture.mjs ../../out/studies/pool/report.html ../../scenes/studies/report.jpg) ;;
    knob) study knob knob -t 1 ;;
    effects) study effects effects -t 1 --repeats 3 --markdown ;;
    motion)
      build/study_motion scenes/boomerang/scene.json --frame 24 --set spp=8 --set gather=256 --set light_step=0 --markdown -t 1 \
        -o scenes/studies/figures/fig-5.7.jpg ;;
    thesis-pool | thesis-gallery | thesis-antique-room | thesis-noise) study "$1" "$1" ;;
    antique-room)
      room reference --spp 512 --guide none
      room protocol --spp 512 --sampling protocol
      room variance --spp 512 --sampling variance --stopping pixel ;;
    figures) bash scenes/studies/figures.sh ;;
    thesis) for part in motion thesis-{pool,gallery,antique-room,noise} antique-room figures; do run "$part"; done ;;
    stages | update | size) benchmark "$1" ;;
    *) echo "report.sh: there is no study $1" >&2; exit 2 ;;
  esac
}

[ $# -gt 0 ] || set -- demo pool thesis knob effects stages update size
for name in "$@"; do run "$name"; done
