#!/usr/bin/env bash
# Installs the build in BUILD (build/) into a folder and moves that folder, because a package must not depend on where it
# was made. Then builds the program of this folder with the package and runs it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
work=$build/consumer
source "$here/../results.sh"
trap 'record "$build" consumer $?' EXIT
rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$work/made" >"$work/install.log"
mv "$work/made" "$work/moved"
cmake -S "$here" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/moved" >"$work/configure.log" ||
  { cat "$work/configure.log"; exit 1; }
cmake --build "$work/build" --parallel "${JOBS:-2}"
"$work/build/consumer"
"$work/moved/bin/aleph" --version
