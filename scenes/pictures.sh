#!/usr/bin/env bash
# Makes the pictures of this folder's READMEs anew. Frames of a film ask for an error of one visible threshold, by the
# stricter model of vision, as a picture is looked at for longer than a frame of a film.
#   bash scenes/pictures.sh [scene ...]     takes minutes; without names all but antique-room
set -euo pipefail
font=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
cd "$(dirname "$0")/.."
bash scenes/setup.sh openimageio-tools
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DALEPH_PRECOMPILE=ON >/dev/null
ninja -C build --quiet aleph

# sheet OUT COLUMNS PICTURE...: side by side in rows.
sheet() {
  local out=$1 columns=$2
  shift 2
  oiiotool "$@" --mosaic "${columns}x$((($# + columns - 1) / columns))" --compression jpeg:80 -o "$out"
}

# shot NAME SIZE COLUMNS FRAMES: frames of a scene. Single frames need no light of lighting keyframes.
shot() {
  echo "$1"
  local out=build/pictures/$1
  rm -rf "$out"
  build/aleph render "scenes/$1/scene.json" --frames "$4" --size "$2" --error 1 --vision castle --light-step 0 -q \
    -o "$out/$1.####.png"
  sheet "scenes/$1/$1.jpg" "$3" "$out"/*.png
}

# folder NAME COLUMNS OPTION...: the middle frame of every scene file in a folder, with its name.
folder() {
  local name=$1 columns=$2 out=build/pictures/$1 file title range
  shift 2
  rm -rf "$out"
  mkdir -p "$out"
  for file in scenes/"$name"/*.json; do
    title=$(basename "$file" .json)
    range=$(sed -n 's/.*"frames": *\[\([0-9]*\), *\([0-9]*\)\].*/(\1 + \2) \/ 2/p' "$file" | head -1)
    build/aleph render "$file" --frames "$(($range))" -q "$@" -o "$out/plain.png"
    oiiotool "$out/plain.png" "--text:x=4:y=12:size=11:shadow=1:font=$font" "$title" -o "$out/$title.png"
    rm "$out/plain.png"
  done
  sheet "scenes/$name/$name.jpg" "$columns" "$out"/*.png
}

picture() {
  case $1 in
    pool) shot pool 400x300 2 5,14,28,80 ;;
    pool-still) shot pool-still 400x300 2 9,13,30,89 ;;
    art-gallery) shot art-gallery 400x300 2 70,205,395,620 ;;
    antique-room) shot antique-room 400x300 2 15,100 ;;  # a quarter of an hour or more
    boomerang)
      build/aleph render scenes/boomerang/scene.json --frames 78 --size 384x288 --error 1 --vision castle --light-step 0 -q \
        -o scenes/boomerang/boomerang.png ;;
    cornell) shot cornell 320x320 3 0,15,30 ;;
    room) shot room 512x512 1 0 ;;
    hard) folder hard 6 --size 160x120 ;;
    materials) folder materials 3 --size 320x240 --spp 1024 ;;
    furnace) build/aleph maps scenes/furnace/scene.json --frames 20 --size 320x240 -q -o scenes/furnace/furnace.png ;;
    *) echo "pictures.sh: there is no picture of $1" >&2; exit 2 ;;
  esac
}

[ $# -gt 0 ] || set -- pool pool-still art-gallery boomerang cornell room hard materials furnace
for name in "$@"; do picture "$name"; done
