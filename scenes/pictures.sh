#!/usr/bin/env bash
# Makes the pictures of this folder's READMEs anew: every frame asks for an error of one visible threshold, by the
# stricter model of vision, as a picture is looked at for longer than a frame of a film. Single frames need no light of
# key moments.
#   bash scenes/pictures.sh [scene ...]     takes minutes; without names all but antique-room
set -euo pipefail
cd "$(dirname "$0")/.."
bash scenes/setup.sh
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DALEPH_PRECOMPILE=ON >/dev/null
ninja -C build --quiet study_contact

# Renders frames $4, $5, ... of scene $1 at size $2, with $3 pictures in a row.
contact() {
  local name=$1 size=$2 columns=$3 frames=() frame
  shift 3
  for frame in "$@"; do frames+=("scenes/$name/scene.json@$frame"); done
  echo "$name"
  build/study_contact "${frames[@]}" --size "$size" --width "${size%x*}" --columns "$columns" --error 1 --set vision=castle --set light_step=0 \
    -o "scenes/$name/$name.jpg" -q
}

picture() {
  case $1 in
    pool) contact pool 400x300 2 5 14 28 80 ;;
    pool-still) contact pool-still 400x300 2 9 13 30 89 ;;
    art-gallery) contact art-gallery 400x300 2 70 205 395 620 ;;
    antique-room) contact antique-room 400x300 2 15 100 ;;  # a quarter of an hour or more
    cornell) contact cornell 320x320 3 0 15 30 ;;
    room) contact room 512x512 1 0 ;;
    *) echo "pictures.sh: there is no picture of $1" >&2; exit 2 ;;
  esac
}

[ $# -gt 0 ] || set -- pool pool-still art-gallery cornell room
for name in "$@"; do picture "$name"; done
