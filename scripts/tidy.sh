#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy 14 with the checks of .clang-tidy over the library and the tools, or over the
# named files.
#   scripts/tidy.sh [FILE...]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${SSLCD_BUILD_DIR:-build/tidy}

command -v run-clang-tidy-14 >/dev/null || { echo "no clang-tidy-14: scripts/install_deps.sh dev" >&2; exit 1; }
cmake --preset dev -B "$build" -DSSLCD_SANITIZE= >/dev/null
if (($# == 0)); then
  set -- "$PWD"/src/ "$PWD"/apps/
fi
run-clang-tidy-14 -quiet -extra-arg=-Wno-unknown-warning-option -p "$build" -j "$(nproc)" "$@"
