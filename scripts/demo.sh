#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Shows closed loops on a fresh machine: installs missing packages, builds the tools, writes
# HALV-sim's first case (around a car park, and back past the same cars in the opposite direction)
# as a sequence folder and runs it with the same reader as real data.
#   scripts/demo.sh [OUT]      OUT: folder of the sequence and the results (default runs/demo)
# SSLCD_BUILD_DIR: where to build (default build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${SSLCD_BUILD_DIR:-build/release}
out=${1:-runs/demo}

scripts/build.sh

"$build/apps/sslcd_sim" halv --case 1 --seed 7 --out "$out/halv" --force
"$build/apps/sslcd_run" run "$out/halv" --groundtruth groundtruth.txt --report --out "$out/map" --force
metric() { sed -n "s/.*\"$1\": *\([0-9.]*\).*/\1/p" "$out/map/metrics.json"; }
echo
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i }
  $(column["decision"]) == "accepted" { angle = $(column["viewpoint_change_deg"])
    n++; if (n == 1 || angle < low) low = angle; if (angle > high) high = angle }
  END { printf "Loops found:  %d, seen from directions %.0f to %.0f degrees apart\n", n, low, high }' "$out/map/loops.csv"
printf 'ATE:          %.2f m before, %.2f m after (RMSE after Sim(3))\n' \
  "$(metric odometry_ate_sim3_rmse_m)" "$(metric ate_sim3_rmse_m)"
echo "The sequence: $out/halv"
echo "The results:  $out/map (map.ply opens in any point cloud viewer, trajectory_tum.txt in evo)"
echo "The report:   $out/map/report.html (opens in any browser)"
