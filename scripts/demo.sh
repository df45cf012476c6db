#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh machine to a first map: installs what is missing, builds the tools, writes a small synthetic street as a
# sequence folder and maps it through the same reader as real data.
#   scripts/demo.sh [OUT]      OUT: where the sequence and the results go (default runs/demo)
# SSLCD_BUILD_DIR: where to build (default build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${SSLCD_BUILD_DIR:-build/release}
out=${1:-runs/demo}

scripts/install_deps.sh build
cmake --preset release -B "$build" -DSSLCD_BUILD_TESTS=OFF >/dev/null
cmake --build "$build" -j "$(nproc)" --target sslcd_sim sslcd_run

"$build/apps/sslcd_sim" street --out "$out/street" --seed 7 --force
"$build/apps/sslcd_run" run "$out/street" --groundtruth groundtruth.txt --out "$out/map"
echo
echo "The sequence: $out/street"
echo "The results:  $out/map (map.ply opens in any point cloud viewer, trajectory_tum.txt in evo)"
