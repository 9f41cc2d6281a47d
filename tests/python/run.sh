#!/usr/bin/env bash
# tests/python/run.sh BUILD PYTHON: the tests of the Python module in a build folder. Options of pytest may follow.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(realpath "$1") python=$2
shift 2
export PYTHONPATH=$build/python ALEPH=$build/aleph PYTHONDONTWRITEBYTECODE=1 MPLCONFIGDIR=$build/python
"$python" -m pytest -q --no-header -p no:cacheprovider "$here" "$@"
