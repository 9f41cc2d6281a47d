#!/usr/bin/env bash
# picture.sh BUILD REPORT.html OUT.jpg: a picture of a report as headless Chromium shows it. BUILD/report has the packages.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
report=$(realpath "$2")
out=$(realpath -m "$3")
cd "$1/report"
node "$here/picture.mjs" "$report" "$out"
