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

command -v npm >/dev/null || skip "npm is not installed; scenes/setup.sh can"
browser=
for name in "${CHROMIUM:-}" chromium chromium-browser google-chrome; do
  [ -n "$name" ] && browser=$(command -v "$name") && break
done
[ -n "$browser" ] || skip "Chromium is not installed; scenes/setup.sh chromium can"
modules=$build/report
mkdir -p "$modules"
(cd "$modules" && bash "$here/bundle.sh" . report-template.html viewer-template.html)
[ -f "$modules/installed" ] || skip "npm could not install the packages of the page, perhaps for want of a network"

code=0
cd "$modules"
[ -s report-template.html ] || code=1
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
exit "$code"
