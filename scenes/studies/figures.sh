#!/usr/bin/env bash
# Makes the figures of THESIS.md from the finished studies in out/studies: pictures in scenes/studies/figures, tables in
# out/studies/tables.txt.
set -euo pipefail
cd "$(dirname "$0")/../.."
studies=out/studies
figures=scenes/studies/figures
mkdir -p "$figures"

# picture STUDY VARIANT FRAME: the file of a run's picture.
picture() {
  awk -v variant="$2" -v frame="$3" -v folder="$studies/$1" -F'": ' '
    /^ *"id": /{ v = $2 } /^ *"frame": /{ f = $2 } /^ *"file": /{ gsub(/[",]/, "", $2); file[v f] = $2 }
    END { path = file["\"" variant "\"," frame ","]; if (path == "") exit 1; print folder "/" path }' "$studies/$1/study.json" ||
    { echo "figures.sh: $studies/$1 has no picture of $2, frame $3" >&2; exit 1; }
}

panels=()
colour() { panels+=("$1=$2"); }
# map CAPTION FILE CHANNEL HIGH: a channel, in colours from 0 to HIGH.
map() { panels+=("$1=$2,$3,0,$4"); }
# sheet NAME COLUMNS WIDTH [OPTION ...]: the panels so far, each WIDTH pixels wide.
sheet() {
  build/study_sheet "${panels[@]}" -o "$figures/fig-$1.jpg" --columns "$2" --width "$3" "${@:4}"
  panels=()
}

# savings STUDY: rays and seconds of the variant `none` over those of each variant, and the error that is added to its error; with 1024 rays, of `none at 1024 rays`.
savings() {
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    {
      variant = $(column["variant"]); frame = $(column["frame"])
      if (!(variant in seen)) { seen[variant] = 1; variants[++count] = variant }
      if (!(frame in shown)) { shown[frame] = 1; frames[++length_of_shot] = frame }
      rays[variant, frame] = $(column["gather_rays"]); seconds[variant, frame] = $(column["processor_seconds"])
      error[variant] += $(column["relative_mse"])
    }
    END {
      head = "| guide | rays, ratio |"; rule = "| --- | ---: |"
      for (f = 1; f <= length_of_shot; ++f) { head = head " frame " frames[f] " |"; rule = rule " ---: |" }
      print head " seconds, ratio | relative MSE, added, thousandths |\n" rule " ---: | ---: |"
      for (v = 1; v <= count; ++v) {
        name = variants[v]; base = name ~ /1024/ ? "none at 1024 rays" : "none"; mean = time = 0; cells = ""
        for (f = 1; f <= length_of_shot; ++f) {
          ratio = rays[base, frames[f]] / rays[name, frames[f]]; mean += ratio / length_of_shot
          time += seconds[base, frames[f]] / seconds[name, frames[f]] / length_of_shot; cells = cells sprintf(" %.2g |", ratio)
        }
        printf "| %s | %.2g |%s %.2g | %.2g |\n", name, mean, cells, time, 1000 * (error[name] - error[base]) / length_of_shot
      }
    }' "$studies/$1/study.csv"
}

# rules STUDY: seconds and records of the frame that fills the cache and of the one that finds it filled; means of samples and errors of both.
rules() {
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    {
      variant = $(column["variant"]); if (!(variant in count)) names[++variants] = variant
      n = ++count[variant]; seconds[variant, n] = $(column["processor_seconds"]); records[variant, n] = $(column["records"])
      samples[variant] += $(column["samples"]) / 2; beyond[variant] += $(column["share_beyond"]) / 2; bias[variant] += $(column["bias"]) / 2
      castle[variant] += $(column["share_beyond.castle"]) / 2; certain[variant] += $(column["share_certain"]) / 2
    }
    END {
      print "| settings | empty cache: records | seconds | ratio | full cache: records | seconds | ratio | samples | beyond (%) | certain (%) | by castleCSF (%) | bias (%) |"
      print "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
      for (v = 1; v <= variants; ++v) {
        name = names[v]; base = names[1]; row = "| " name " |"
        for (n = 1; n <= 2; ++n)
          row = row sprintf(" %d | %.3g | %.2g |", records[name, n], seconds[name, n], seconds[base, n] / seconds[name, n])
        printf "%s %.0f | %.2g | %.2g | %.2g | %.2f |\n", row, samples[name], beyond[name], certain[name], castle[name], bias[name]
      }
    }' "$studies/$1/study.csv"
}

# visibility STUDY: what the models of vision say of each variant, and how much brighter it is; means over the frames.
visibility() {
  awk -F, '
    BEGIN { count = split("share_seen share_flicker share_lasting share_beyond share_beyond.castle bias", metrics, " ") }
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    {
      variant = $(column["variant"]); if (!frames[variant]++) names[++variants] = variant
      for (m = 1; m <= count; ++m) sum[variant, m] += $(column[metrics[m]])
    }
    END {
      print "| noise, times the threshold | seen (%) | flicker (%) | lasting (%) | beyond one threshold (%) | by castleCSF (%) | brighter (%) |"
      print "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"
      for (v = 1; v <= variants; ++v) {
        row = "| " names[v] " |"; for (m = 1; m <= count; ++m) row = row sprintf(" %.0f |", sum[names[v], m] / frames[names[v]]); sub(/-0 /, "0 ", row); print row
      }
    }' "$studies/$1/study.csv"
}

compressed=$(picture thesis-pool saliency 40) added=$(picture thesis-pool "saliency and scale-and-add" 40)
map "frame 40, compressive: accuracy" "$compressed" alpha.acc 1
map "values computed" "$compressed" records.Y 1
map "scale and add: accuracy" "$added" alpha.acc 1
map "values computed" "$added" records.Y 1
sheet 6.3 2 320

for frame in 20 40 60; do
  for guide in none full saliency; do colour "frame $frame: $guide" "$(picture thesis-pool $guide $frame)"; done
done
sheet 6.4 3 240

for guide in none saliency; do
  for frame in 0 300 540 720; do colour "frame $frame: $guide" "$(picture thesis-gallery $guide $frame)"; done
done
sheet 6.10 4 240

for frame in 0 540; do
  for guide in none full saliency; do map "frame $frame: $guide" "$(picture thesis-gallery $guide $frame)" records.Y 1; done
done
sheet 6.11 3 320

room=thesis-antique-room
for variant in "uniform without guide" "uniform with guided cache" "consecutive (6.10)" "variance (6.12) of the mean"; do
  colour "$variant" "$(picture $room "$variant" 32)"
done
sheet 6.12 2 320

# The reference, and the two rules as the thesis has them, larger than the study.
for rule in "variance (6.12) as printed" "protocol (6.13)"; do
  colour "$rule" "$studies/antique-room/${rule%% *}.exr"
  map "samples" "$studies/antique-room/${rule%% *}.exr" samples.Y 512
done
sheet 6.15 2 320

for rule in reference "variance (6.12) as printed" "protocol (6.13)"; do colour "$rule" "$studies/antique-room/${rule%% *}.exr"; done
sheet 6.16 3 320 --crop 264,178,40,30

noise=thesis-noise
build/aleph maps scenes/art-gallery/scene.json --frames 300 --size 320x240 -q -o $studies/$noise/maps.exr
colour "frame 300, reference" "$(picture $noise 0 300)"
map "visible threshold (6.9), cd/m2" $studies/$noise/maps.exr threshold.Y 100
colour "noise of zero mean, 1 threshold" "$(picture $noise "1 of zero mean" 300)"
for level in 0.5 1 2; do colour "noise from 0 to $level thresholds" "$(picture $noise "$level from 0" 300)"; done
sheet 7.1 3 320

{
  echo "6.3" && savings thesis-pool && echo "6.10" && savings thesis-gallery && echo "6.14" && rules $room && echo "7.1" && visibility $noise
} >$studies/tables.txt
