#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the tests on a fresh machine: installs missing packages, configures, builds, tests.
#   scripts/test.sh [ctest arguments, e.g. -L unit]
# SSLCD_BUILD_DIR: build folder (default build/release). SSLCD_DATA_DIR: real data (see
# CONTRIBUTING.md). SSLCD_CMAKE_ARGS: more arguments for configuring.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${SSLCD_BUILD_DIR:-build/release}
jobs=$(nproc)

scripts/install_deps.sh test
# apt's packages are for apt's Python
cmake --preset release -B "$build" -DSSLCD_BUILD_TESTS=ON -DSSLCD_BUILD_PYTHON=ON \
  -DPython_EXECUTABLE=/usr/bin/python3 ${SSLCD_DATA_DIR:+-DSSLCD_DATA_DIR="$SSLCD_DATA_DIR"} \
  ${SSLCD_CMAKE_ARGS:-}
cmake --build "$build" -j "$jobs"
status=0
ctest --test-dir "$build" -j "$jobs" --output-on-failure --output-log "$build/ctest.log" "$@" || status=$?
grep 'tests passed' "$build/ctest.log" || true  # once more, below ctest's list of what was skipped
exit $status
