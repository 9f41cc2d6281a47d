#!/usr/bin/env bash
# Set-up, build and all tests, from any folder. What CI runs.
#   tests/run.sh          everything: about 15 minutes on two cores, 25 where ccache has no objects yet
#   tests/run.sh quick    without the sanitizer builds
# JOBS is the number of compilers and test programs at a time (2). Writes into build/ and build-*/ only.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/.." && pwd)
build=$root/build
jobs=${JOBS:-2}
source "$here/results.sh"

case ${1:-} in
  "" | quick) ;;
  *) sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2 ;;
esac

times=()
# part TITLE COMMAND...: says what runs and keeps how long it took.
part() {
  local title=$1 start=$SECONDS code=0
  shift
  printf '\n== %s\n' "$title"
  "$@" || code=$?
  times+=("$(printf '%5d s  %s' $((SECONDS - start)) "$title")")
  return "$code"
}

configure() {
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DALEPH_SANITIZE= -DALEPH_TESTS=ON -DALEPH_PRECOMPILE=ON
}

# Nothing can be tested without these.
needed() {
  part "$@" || { printf '\n%s failed\n0 passed, 1 failed\n' "$1"; exit 1; }
}

# checked FOLDER TITLE COMMAND...: a part whose failures are counted, also those that left no result (a broken build).
checked() {
  local folder=$1
  shift
  part "$@" || grep -qs '<testsuites [^>]*failures="[1-9]' "$folder"/results/*.xml || record "$folder" "$1" 1
}

rm -rf "$build/results" "$root/build-address/results" "$root/build-thread/results"
# Chromium opens the page of study reports; qemu stands in for another processor.
needed "set-up" bash "$root/scenes/setup.sh" chromium qemu-user
needed "configure" configure
needed "build" cmake --build "$build" --parallel "$jobs"
checked "$build" "tests" run_tests "$build"
if [ "${1:-}" != quick ]; then
  checked "$root/build-address" "address sanitizer" bash "$here/sanitizers.sh" readers
  checked "$root/build-thread" "thread sanitizer" bash "$here/sanitizers.sh" thread
fi

printf '\n'
printf '%s\n' "${times[@]}"
summarize "$build" "$root/build-address" "$root/build-thread"
