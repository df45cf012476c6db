#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs every KITTI tracking sequence that is there with one configuration and prints the table of docs/results.md.
#   scripts/kitti_results.sh KITTI_TRACKING [DETECTIONS...]     e.g. DATA/kitti-tracking det_pointrcnn_car
# SSLCD_BUILD_DIR: where sslcd_run was built (default build/release). Needs python3.
set -euo pipefail
data=${1:?usage: scripts/kitti_results.sh KITTI_TRACKING [DETECTIONS...]}
shift
sets=("$@")
((${#sets[@]})) || sets=(det_pointrcnn_car det_stereo_grade_car)
build=${SSLCD_BUILD_DIR:-$(dirname "$0")/../build/release}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

echo "| detections | sequence | ATE odometry -> ours [m] | IoU raw -> map | coverage | purity | static found | landmarks per static | driving in map |"
echo "|---|---|---|---|---|---|---|---|---|"
for set in "${sets[@]}"; do
  for file in "$data/$set"/*.txt; do
    sequence=$(basename "$file" .txt)
    truth=()
    [[ -e $data/oxts_cam0_poses/$sequence.txt ]] && truth=(--groundtruth oxts_cam0_poses)
    "$build/apps/sslcd_run" run "$data" --sequence "$sequence" --detections "$set" --odometry orbslam3_poses \
      "${truth[@]}" --out "$out" --json |
      python3 -c '
import json, sys
m = json.load(sys.stdin)
ate = "%.2f -> %.2f" % (m["odometry_ate_se3_rmse_m"], m["ate_se3_rmse_m"]) if "ate_se3_rmse_m" in m else "no true poses"
print("| %s | %s | %s | %.3f -> %.3f | %.1f %% | %.3f | %.3f | %.2f | %.2f |" % (sys.argv[1], sys.argv[2], ate, m["iou_raw"],
      m["iou_map"], 100 * m["coverage"], m["purity"], m["static_found"], m["landmarks_per_static"], m["driving_in_map"]))' \
        "$set" "$sequence"
  done
done
