#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs missing packages and builds the tools, sslcd_run and sslcd_sim, in build/release/apps.
#   scripts/build.sh [vision]      vision: installs ONNX Runtime, too, to run models
# SSLCD_BUILD_DIR: where to build (default build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-build}" in
  build | vision) ;;
  *) echo "usage: scripts/build.sh [vision]" >&2; exit 2 ;;
esac
build=${SSLCD_BUILD_DIR:-build/release}
scripts/install_deps.sh "${1:-build}"
cmake --preset release -B "$build" -DSSLCD_BUILD_TESTS=OFF >/dev/null
cmake --build "$build" -j "$(nproc)" --target sslcd_sim sslcd_run
echo "The tools: $build/apps/sslcd_run --help"
