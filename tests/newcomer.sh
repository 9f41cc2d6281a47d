#!/usr/bin/env bash
# Commands that people try on their first days, and what they have to answer. About twenty seconds of processor time.
#   tests/newcomer.sh [PROGRAM]     PROGRAM: build/aleph
set -uo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=$(realpath "${1:-$root/build/aleph}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0 checks=0
quick=(--size 16x12 --spp 1 --gather 4)

aleph() { "$program" "$@"; }

fail() {
  printf 'FAILED: %s\n' "$1"
  sed 's/^/  /' output
  failures=$((failures + 1))
}

# answers CODE PART COMMAND...: the exit code, and a part of what is printed.
answers() {
  local code=$1 part=$2 got=0
  shift 2
  checks=$((checks + 1))
  "$@" >output 2>&1 || got=$?
  if [ "$got" != "$code" ] || ! grep -qF -- "$part" output; then fail "expected $code and '$part', got $got: $*"; fi
}

# also PART: another part of what the last command printed.
also() {
  checks=$((checks + 1))
  grep -qF -- "$1" output || fail "expected '$1' too"
}

# silent COMMAND...: works without a word.
silent() {
  checks=$((checks + 1))
  "$@" >output 2>&1 && [ ! -s output ] || fail "expected success without a word: $*"
}

# killed_after PATTERN OPTIONS...: starts the program and kills it once a file of that name is there. If it ends first, the
# checks that follow hold too. Not by aleph(): the shell that runs a function would be killed, and the program go on.
killed_after() {
  "$program" "${@:2}" >output 2>&1 &
  until compgen -G "$1" >/dev/null || ! kill -0 $! 2>/dev/null; do sleep 0.05; done
  kill -KILL $! 2>/dev/null
  wait $! 2>/dev/null
}

# is COMMAND...: a condition.
is() {
  checks=$((checks + 1))
  : >output
  "$@" >output 2>&1 || fail "$*"
}

# A first scene.
answers 0 "wrote begin.json" aleph new begin.json
answers 2 "is there already" aleph new begin.json
answers 2 "ends in .json" aleph new begin.glb
answers 0 "frames    0 to 47 at 24 a second" aleph explain begin.json
answers 0 "warning: frame 99 lies outside the shot, which has the frames 0 to 47" aleph explain begin.json --frames 99 --size 16x12
silent aleph render begin.json "${quick[@]}" --frames 24 -q -o begin.png
answers 0 "wrote new/folder/begin.json" aleph new new/folder/begin.json
rm -r begin.* new

cat >first.json <<'JSON'
{"aleph": 1, "fps": 30, "frames": [0, 59],
 "nodes": [
  {"name": "floor", "rotation": {"axis": [1, 0, 0], "degrees": -90}, "shape": {"type": "quad", "size": [6, 6]}},
  {"name": "ball", "translation": {"keys": [[0, [-1, 0.5, 0]], [59, [1, 0.5, 0]]]}, "shape": {"type": "sphere", "radius": 0.5}},
  {"name": "lamp", "translation": [0, 3, 0], "rotation": {"axis": [1, 0, 0], "degrees": 90},
   "shape": {"type": "quad", "size": [1, 1]}, "material": {"base_color": [0, 0, 0], "emission": [12, 11, 10]}},
  {"name": "eye", "translation": [0, 1.2, 5], "camera": {"fov": 40}}]}
JSON

# Output files.
for name in x.jpg x.tif out.with.dots 'frame.####'; do
  answers 2 "possible are .exr and .png, or a folder" aleph render first.json --frames 0 "${quick[@]}" -o "$name"
done
answers 2 "standard output" aleph render first.json --frames 0 "${quick[@]}" -o -
is [ "$(ls)" = "$(printf 'first.json\noutput')" ]
silent aleph render first.json --frames 0-1 "${quick[@]}" -q -o both/
silent aleph maps first.json --frames 0 "${quick[@]}" -q -o both/
is [ "$(ls both | tr '\n' ' ')" = "first-maps.0000.exr first.0000.exr first.0001.exr " ]
answers 0 "wrote new/deep/first.0000.exr to new/deep/first.0001.exr (2 frames), statistics in stats/all.json" \
  aleph render first.json --frames 0-1 "${quick[@]}" -o new/deep/ --stats stats/all.json
is grep -q '"spp": 1,' stats/all.json
answers 1 "File name too long" aleph render first.json --frames 0 "${quick[@]}" -o "$(printf 'n%.0s' {1..260}).exr"
# Nobody can write to /proc. That is found before the first frame of a long render.
answers 1 "/proc/x.exr" aleph render first.json --frames 0 --size 4000x3000 -o /proc/x.exr
answers 1 "/proc/s.json" aleph render first.json --frames 0 --size 4000x3000 -o x.exr --stats /proc/s.json

# A window of the picture: wrong ones, the same pixels, and a film of it.
answers 2 "--crop: '0,17,0,4': expected X0,X1,Y0,Y1 with 0 <= X0 < X1 <= 16" aleph render first.json "${quick[@]}" --crop 0,17,0,4 -o crop.exr
answers 2 "--crop: '8,4,0,4': expected X0,X1,Y0,Y1" aleph maps first.json "${quick[@]}" --crop 8,4,0,4 -o crop.exr
is [ ! -e crop.exr ]
silent aleph maps first.json "${quick[@]}" --frames 0 -q -o whole.exr
silent aleph maps first.json "${quick[@]}" --frames 0 -q --crop 4,12,2,9 -o crop.exr
answers 0 "0 of 56 pixels" aleph compare whole.exr crop.exr
answers 0 "wrote crop.mp4: 2 frames of 8x6, 30 a second" aleph render first.json --frames 0-1 "${quick[@]}" --crop 4,12,2,8 -o crop.mp4
rm whole.exr crop.*

# --strict tells whether the error asked for is kept.
answers 3 "in 1 of 1 frames more than 1 % of the pixels err by more than was asked for" aleph render first.json --size 16x12 --error .2 --spp 2 --frames 0 --strict -q -o strict.exr
rm strict.exr

# Films: a mistyped ending, and a system without ffmpeg. Nothing is rendered or left.
answers 2 "the extension .mp5 is not known; possible are .exr and .png" aleph render first.json --size 4000x3000 -o film.mp5
answers 1 "the program ffmpeg, which is not in PATH: install it" env PATH=/nowhere "$program" render first.json --size 4000x3000 -o film.mp4
is [ -z "$(ls -A | grep film)" ]
answers 0 "wrote film.mp4: 2 frames of 16x12, 30 a second" aleph render first.json --frames 0-1 "${quick[@]}" -o film.mp4
silent aleph preview first.json --frames 0-9 -q -o preview.mp4
is [ "$(ls -A | grep -e film -e preview | tr '\n' ' ')" = "film.mp4 preview.mp4 preview.png " ]

# Statistics of finished frames outlive the program.
killed_after killed.json render first.json --size 64x48 --spp 4 -q -o killed/ --stats killed.json
is [ "$(tail -1 killed.json)" = "}" ]
is grep -q '"frame": 0' killed.json

# A lamp that shines away from all there is.
sed 's/"translation": \[0, 3, 0\]/"translation": [0, -3, 0]/' first.json >below.json
answers 0 'exposure  1, since its frames show no direct light' aleph explain below.json
answers 0 'warning: every pixel is black' aleph render below.json --frames 0 "${quick[@]}" -o below.exr
rm below.*

# Options.
answers 2 'reference is required' aleph compare first.json
answers 2 'there is no option --frame; did you mean "--frames"?' aleph render first.json --frame 0
answers 2 'did you mean "--spp"?' aleph render first.json --sapp 4
answers 2 'there is no command rendr; did you mean "render"?' aleph rendr first.json
answers 2 'did you mean "exposure"?' aleph render first.json --set exposre=2
answers 2 'viewing.display_white' aleph render first.json --set white=2
answers 2 'expected KEY=VALUE' aleph render first.json --set exposure
answers 2 'expected seconds above 0' aleph render first.json --verify 0
silent aleph maps first.json --frames 3 "${quick[@]}" -q -o preview.####.png
is [ -s preview.0003.png ]
answers 2 'expected 0 (all processors) to 4096' aleph render first.json -t -1
answers 2 'expected 0 (all processors) to 4096' aleph maps --images 'x.####.png' -t 4097
answers 2 'error: --exposure: expected a number above 0' aleph maps first.json --exposure -1
answers 2 'error: --error: this setting needs a scene' aleph maps --images 'x.####.png' --error 1
silent aleph render first.json "${quick[@]}" -t 0 -q --frames 7 --frames 0 --spp 9 --set spp=8 --spp 2 -o twice.exr --stats twice.json
is grep -q '"spp": 2,' twice.json
is grep -q '"frame": 0,' twice.json
silent aleph render first.json "${quick[@]}" -q --frames 0 --spp 9 --set spp=8 -o twice.exr --stats twice.json
is grep -q '"spp": 8,' twice.json

# Values that were probably meant otherwise: one warning each.
# scene NAME NODE [MORE]: a lit scene of one node.
scene() {
  printf '{"aleph": 1, "frames": [0, 20], "environment": [1, 1, 1], %s "nodes": [{"name": "n", %s}]}\n' "${3:-}" "$2" >"$1.json"
}
# explains CODE PART NODE [MORE]: the answer for such a scene.
explains() {
  scene key "${@:3}"
  answers "$1" "$2" aleph explain key.json
}
explains 0 'looks like radians' '"camera": {"fov": 0.7}'
explains 0 'look like radians' '"rotation": {"axis": [1, 0, 0], "degrees": -1.5708}'
explains 0 'look like radians' '"operations": [{"rotate_y": 1.5708}]'
explains 0 'step keys move it at frame 10, which is not in "cuts"' \
  '"camera": {}, "translation": {"interpolation": "step", "keys": [[0, [0, 0, 5]], [10, [3, 0, 5]]]}'
explains 0 'the cut at frame 50 lies outside the frames 0 to 20' '"camera": {}' '"cuts": [50],'
explains 0 'the scale is 0' '"shape": {"type": "box"}, "scale": 0'
answers 0 'warning: frame 100 lies outside the shot, which has the frames 0 to 59' \
  aleph render first.json "${quick[@]}" --frames 0,100 -o outside/

# Keys and values of other formats; commas.
explains 2 '/nodes/0/position: unknown key "position"; a node'"'"'s place is "translation"' '"position": [0, 0, 1]'
explains 2 '"operations": [{"rotate_z": 0}, {"rotate_y": 90}, {"rotate_x": 0}]' '"rotation": [0, 90, 0]'
explains 2 'a "shape" and a "material" that has "emission"' '"light": {"type": "area"}'
explains 2 'write "error": 1' '"camera": {}' '"settings": {"sampling": "progressive"},'
explains 2 '/keys/0: expected a key: [time, value] or a cubic key' '"translation": {"keys": [{"frame": 0, "value": [0, 0, 1]}]}'
explains 2 '/keys/0/1: expected a list of 3 numbers, found 0' '"translation": {"keys": [[0, 0, 0, 1], [9, 1, 0, 1]]}'
explains 0 'keys lie outside the frames 0 to 20' '"translation": {"keys": [[100, [0, 0, 0]], [200, [1, 0, 0]]]}'
explains 2 'write {"type": "sphere"}' '"shape": "sphere"'
explains 2 'name the node that has the "include"' '"parent": "wheel"' '"include": "car.glb",'
printf '{"aleph": 1,\n "fps": 30\n "frames": [0, 1]}\n' >key.json
answers 2 'line 2, column 11: not valid JSON: a comma is missing here' aleph explain key.json
printf '{"asset": {"version": "2.0"}\n "nodes": []}\n' >comma.gltf
answers 2 'comma.gltf: line 1, column 29: not valid JSON: a comma is missing here' aleph explain comma.gltf
printf 'PNG {' >picture.glb
answers 2 'picture.glb: this is not a GLB file: it does not begin with "glTF"' aleph explain picture.glb
answers 2 'this is a folder; expected a .json, .gltf, .glb or .abc file' aleph explain .

# Keys that are computed on load: easing, look_at, follow_path and named values, and a slip in each.
scene eased '"camera": {}, "translation": {"interpolation": "ease", "keys": [[0, [0, 0, 5]], [20, [0, 1, 5]]]}'
answers 0 'cubic' aleph explain eased.json --json
explains 2 '"smooth", "ease", "ease_in" or "ease_out", found the text "ease-in"' \
  '"translation": {"interpolation": "ease-in", "keys": [[0, [0, 0, 5]], [20, [0, 1, 5]]]}'
scene looking '"camera": {}, "translation": [0, 1, 5], "look_at": [0, 0, 0]'
silent aleph render looking.json "${quick[@]}" --frames 0 -q -o looking.exr
explains 2 '/nodes/0/look_at: there is no node called "bal"; did you mean "ball"?' \
  '"camera": {}, "look_at": "bal"}, {"name": "ball"'
explains 2 '"look_at" of the node' '"camera": {"target": [0, 0, 0]}'
scene moving '"camera": {}, "follow_path": {"points": [[0, 0, 5], [2, 1, 4]], "at": {"keys": [[0, 0], [20, 1]]}}'
silent aleph render moving.json "${quick[@]}" --frames 0,20 -q -o moving/
explains 2 'unknown key "aligned"; did you mean "align"?' \
  '"follow_path": {"points": [[0, 0, 5], [2, 1, 4]], "at": 0, "aligned": true}'
scene shared '"camera": {}, "translation": [0, {"named": "height"}, 5]' '"named": {"height": 1.5},'
silent aleph render shared.json "${quick[@]}" --frames 0 -q -o shared.exr
explains 2 'there is no named value "hight"; did you mean "height"?' \
  '"translation": [0, {"named": "hight"}, 5]' '"named": {"height": 1.5},'
explains 2 '/nodes/0/translation: expected a list of 3 numbers or an object with "keys" or "values", found 1.5; this value is defined at /named/height' \
  '"translation": {"named": "height"}' '"named": {"height": 1.5},'

# Scenes for other programs.
answers 2 'must end in .json or .glb' aleph export first.json -o first.obj
answers 2 '--output' aleph export first.json -o first.json
silent aleph export first.json --bake -o first.glb
answers 0 'frames    0 to 59 at 30 a second' aleph explain first.glb

# Contents of the scene, and which object a pixel shows.
answers 0 '1 light (1 of area)' aleph explain first.json
also 'lamp: 2 triangles of'
also 'glossy_reflection'  # of the effects plan
answers 0 '"object_ids": [' aleph explain first.json --json
also '"decision": "skip"'
answers 0 'v positive upwards' bash -c 'grep -a "" both/first-maps.0000.exr'
answers 0 'uint32_to_float32' bash -c 'grep -a "" both/first-maps.0000.exr'
answers 0 '/ball' bash -c 'grep -a "" both/first-maps.0000.exr'
explains 0 'rendering is refused: camera: the scene has no camera' '"shape": {"type": "box"}'

# The effects plan: what cannot be named, and what is forbidden.
answers 2 'there is no effect shine; known are direct_light' aleph render first.json "${quick[@]}" -q --forbid shine -o shine.exr
answers 2 'expected one of on, off' aleph render first.json "${quick[@]}" -q --plan none -o plan.exr
silent aleph render first.json "${quick[@]}" --frames 0 -q --forbid area_shadows --forbid emission --stats forbidden.json -o forbidden.exr
answers 0 '"reason": "forbidden"' cat forbidden.json
silent aleph maps first.json --size 16x12 --frames 0 -q --importance -o importance.png

# Studies: what is asked for, what is written, and that a killed one goes on.
study=(--size 16x12 --frames 0 --reference-spp 2 --reference-passes 2)
answers 2 'nothing to compare' aleph study first.json "${study[@]}"
answers 2 'expected KEY=VALUE' aleph study first.json "${study[@]}" --sweep error
answers 2 '--sweep: gathr: there is no such setting; did you mean "gather"' aleph study first.json "${study[@]}" --sweep gathr=1,2
answers 2 '--set: noise: there is no such setting' aleph study first.json "${study[@]}" --sweep spp=1 --set noise=1
answers 2 '--set: spp: expected a whole number' aleph study first.json "${study[@]}" --sweep error=1 --set spp=0
answers 2 'error: --sweep: noise: expected a number from 0 to 1000' aleph study first.json --sweep noise=-1
answers 2 'error: --size: expected WIDTHxHEIGHT' aleph study first.json --sweep spp=1 --size 0x0
answers 0 'or a folder, to be named; of a study' aleph farm slurm --help
answers 2 'pictures of a study have one size' aleph study first.json "${study[@]}" --sweep size=16x12,32x24
answers 2 '-1: expected 0' aleph study first.json "${study[@]}" --sweep spp=1,2 --repeats -1
answers 0 'spp=2' aleph study first.json "${study[@]}" --sweep spp=1,2 -o swept
answers 2 'no file' aleph study first.json "${study[@]}" --sweep spp=1 --pictures other=none.####.exr
is [ "$(wc -l <swept/study.csv)" = 3 ]
answers 0 'warning: frame 99 lies outside the shot, which has the frames 0 to 59' aleph study first.json "${study[@]}" --frames 99 --sweep spp=1
is grep -q '"command": "aleph study first.json' swept/study.json
is grep -q '"share_beyond"' swept/study.json
is grep -q '"file": "runs/' swept/study.json
answers 2 'no variant is called nope' aleph study first.json "${study[@]}" --sweep spp=1,2 -o swept --errors nope
answers 0 'errors.jpg' aleph study first.json "${study[@]}" --sweep spp=1,2 -o swept --errors spp=2
is [ -s swept/errors.jpg ]
answers 0 '0 runs made, 2 found finished' aleph study first.json "${study[@]}" --sweep spp=1,2 -o swept
answers 2 'add --search' aleph study first.json "${study[@]}" --sweep spp=1,2 --candidates 4
answers 0 'Best fixed settings of first, of 4 candidates' aleph study first.json "${study[@]}" --sweep error=4 --search --candidates 4 -o searched
answers 0 '0 runs made, 8 found finished' aleph study first.json "${study[@]}" --sweep error=4 --search --candidates 4 -o searched
echo '{"scenes": [{"scene": "first.json", "frames": "0"}], "size": "16x12", "sweeps": {"spp": [1]}}' >typo.json
answers 2 '/sweeps' aleph study typo.json
sed 's/sweeps/sweep/; s/\[1\]/[0]/' typo.json >zero.json
answers 2 'zero.json: spp: expected a whole number from 1 to 65536' aleph study zero.json
mkdir -p barred/runs && touch barred/references
answers 1 'barred/references: cannot create the folder: Not a directory' aleph study first.json "${study[@]}" --sweep spp=1 -o barred
answers 1 'typo.json/runs: cannot create the folder: Not a directory' aleph study first.json "${study[@]}" --sweep spp=1 -o typo.json
echo '{"scenes": [{"scene": "first.json", "frames": "0-1"}], "size": "24x18", "sweep": {"spp": [16, 32, 64]}, "repeats": 2,
  "reference": {"passes": 2, "spp": 16}}' >long.json
killed_after "killed/runs/*.json" study long.json -q -o killed
answers 0 'spp=64' aleph study long.json -o killed
answers 0 'spp=64' aleph study long.json -o whole
numbers() { cut -d, -f5,7,9,11,13,15,17,19 "$1/study.csv"; }
is [ "$(head -1 whole/study.csv | cut -d, -f5,7,9)" = processor_seconds,share_seen,share_flicker ]
is [ "$(numbers killed | cut -d, -f2-)" = "$(numbers whole | cut -d, -f2-)" ]

# Two sequences: one line for each frame, and a summary.
silent aleph render first.json --frames 0-1 "${quick[@]}" --seed 5 -q -o other/
answers 1 'frames differ; the largest difference is in frame' aleph compare 'both/first.####.exr' other/
is [ "$(grep -cE '^ *[01] ' output)" = 2 ]
answers 0 'same' aleph compare 'both/first.####.exr' new/deep/
answers 2 "there is no file or folder 'others/'" aleph compare 'both/first.####.exr' others/
answers 2 "has no channel 'forward.u': give files of \`aleph maps\`" aleph compare both/first.0000.exr other/first.0000.exr --seen other/first.0000.exr
answers 1 'frames differ' aleph compare 'both/first.####.exr' other/ --junit results.xml
is grep -q '<failure message="' results.xml

echo "$((checks - failures)) of $checks answers are right"
[ "$failures" = 0 ]
