#!/usr/bin/env bash
# tests/recorded.sh BUILD NAME COMMAND...: runs a check that is not a program of GoogleTest, and counts it in BUILD/results.
# Exit code 77 of the command says that it was skipped.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/results.sh"
code=0
"${@:3}" || code=$?
[ "$code" = 77 ] || record "$1" "$2" "$code"
exit "$code"
