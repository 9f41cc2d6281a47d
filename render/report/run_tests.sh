#!/usr/bin/env bash
# run_tests.sh BUILD [REPORT.html]: tests the report page in a headless Chromium, on synthetic data and on a report that
# BUILD/aleph writes, or on the one that is given. Builds the page at BUILD/report/report-template.html.
# Ends with 0 (passed), 1 (failed), or 77 (skipped, said why).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(cd "$1" && pwd)
report=${2:+$(realpath "$2")}
source "$here/../../tests/results.sh"

skip() {
  echo "skipped: $1"
  record_skip "$build" report_page "$1"
  exit 77
}

for tool in node npm; do
  command -v "$tool" >/dev/null || skip "$tool is not installed; scenes/setup.sh can"
done
browser=
for name in "${CHROMIUM:-}" chromium chromium-browser google-chrome; do
  [ -n "$name" ] && browser=$(command -v "$name") && break
done
[ -n "$browser" ] || skip "Chromium is not installed; scenes/setup.sh chromium can"
modules=$build/report
mkdir -p "$modules"
if ! cmp -s "$here/package-lock.json" "$modules/package-lock.json" || [ ! -f "$modules/installed" ]; then
  rm -f "$modules/installed"
  cp "$here/package.json" "$here/package-lock.json" "$modules/"
  (cd "$modules" && npm ci --no-audit --no-fund >npm.log 2>&1) ||
    skip "npm could not install the packages of the page, perhaps for want of a network; its log is in the build folder"
  : >"$modules/installed"
fi

code=0
cd "$modules"
node "$here/build.mjs" "$modules/report-template.html" || code=1
if [ "$code" = 0 ]; then
  CHROMIUM=$browser BUILD=$modules node --test --test-concurrency=1 --test-reporter=spec "$here"/test/*.test.mjs || code=1
  if [ -z "$report" ] && [ -x "$build/aleph" ]; then
    report=$build/report-study/report.html
    "$build/aleph" study "$here/../../scenes/cornell/scene.json" --size 48x36 --frames 3 --reference-spp 4 --sweep error=1,4 \
      --sweep guide=none,saliency -q -o "$build/report-study" >/dev/null || code=1
  fi
  if [ -n "$report" ]; then
    CHROMIUM=$browser REPORT=$report node --test --test-reporter=spec "$here/test/report_check.mjs" || code=1
  fi
fi
record "$build" report_page "$code"
exit "$code"
