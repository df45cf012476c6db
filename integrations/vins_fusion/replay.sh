#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# replay.sh CHECKOUT PREFIX [CASE [IMU [SEED]]]: object loops in the real VINS-Fusion. Copies the
# checkout, applies apply.sh to the copy, builds its loop_fusion against the sslcd in PREFIX, plays a
# HALV-sim sequence (CASE 1 to 4, IMU 0 or 1) through a roscore, and prints the loops in VINS's pose
# graph and the ATE of VINS's cameras, after Sim(3), before and after its optimiser.
# Works in $REPLAY_DIR (./replay), which keeps the build. $REPLAY_HZ keyframes a second (10),
# $REPLAY_PORT of the roscore (11399), $REPLAY_FLAGS for the compiler (a CMake list).
set -euo pipefail

[[ $# -ge 2 && $# -le 5 ]] || { sed -n '3,8s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
checkout=$(cd "$1" && pwd)
prefix=$(cd "$2" && pwd)
case=${3:-1} imu=${4:-0} seed=${5:-7}
hz=${REPLAY_HZ:-10}
mkdir -p "${REPLAY_DIR:-replay}"
work=$(cd "${REPLAY_DIR:-replay}" && pwd)
export PATH=$prefix/bin:/usr/bin:$PATH  # Debian's ROS is for Debian's Python
export ROS_PACKAGE_PATH=$work/src ROS_MASTER_URI=http://localhost:${REPLAY_PORT:-11399}
for tool in sslcd_sim sslcd_run roscore cmake; do
  command -v $tool > /dev/null || { echo "replay.sh: no $tool" >&2; exit 1; }
done

# Visual loops need VINS's vocabulary. Without it loop_fusion would end at once.
patch_missing_files() {
  local files=$work/src/support_files
  if [[ ! -f $files/brief_k10L6.bin ]]; then
    echo "no support_files/brief_k10L6.bin: VINS closes no loops itself"
    sed -i 's|posegraph.loadVocabulary(|if (false) &|' "$work/src/loop_fusion/src/pose_graph_node.cpp"
    sed -i '/^int PoseGraph::detectLoop(/,/{/s|{|{ return -1;|' "$work/src/loop_fusion/src/pose_graph.cpp"
  fi
  [[ -f $files/brief_pattern.yml ]] || {
    mkdir -p "$files"
    awk 'BEGIN { print "%YAML:1.0"; srand(1)
      for (k = 0; k < 4; ++k) {
        printf "%s: [", substr("x1y1x2y2", 2 * k + 1, 2)
        for (i = 0; i < 256; ++i) printf "%s%d", i ? ", " : "", int(rand() * 48) - 24
        print "]" } }' > "$files/brief_pattern.yml"
  }
}

# VINS is for OpenCV 3: names that OpenCV 4 has in its C headers.
shims() {
  cat > "$work/shims.cmake" <<'SHIMS'
add_compile_options($ENV{REPLAY_FLAGS} -std=c++17 "SHELL:-include opencv2/imgproc/types_c.h"
  "SHELL:-include opencv2/imgproc/imgproc_c.h" "SHELL:-include opencv2/calib3d/calib3d_c.h"
  -DCV_FONT_HERSHEY_SIMPLEX=cv::FONT_HERSHEY_SIMPLEX -w)
SHIMS
}

build() {  # PACKAGE TARGET
  cmake -S "$work/src/$1" -B "$work/build_$1" -DPYTHON_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_PROJECT_"$1"_INCLUDE="$work/shims.cmake" -DCATKIN_DEVEL_PREFIX="$work/devel/$1" \
    -DCMAKE_PREFIX_PATH="$work/devel/camera_models;$prefix" > "$work/$1.log" 2>&1 &&
    cmake --build "$work/build_$1" --target "$2" >> "$work/$1.log" 2>&1 ||
    { tail -20 "$work/$1.log" >&2; echo "replay.sh: $1 does not build" >&2; exit 1; }
}

if [[ ! -d $work/src ]]; then
  mkdir -p "$work/src.new"
  cp -r "$checkout/camera_models" "$checkout/loop_fusion" "$work/src.new/"
  [[ ! -d $checkout/support_files ]] || cp -r "$checkout/support_files" "$work/src.new/"
  mv "$work/src.new" "$work/src"
  patch_missing_files
fi
bash "$here/apply.sh" "$work/src"
shims
echo "building (minutes the first time; $work/*.log)"
build camera_models camera_models
build loop_fusion loop_fusion_node
node=$(find "$work/devel/loop_fusion" -name loop_fusion_node -type f | head -1)

run=$work/case${case}_imu${imu}_seed$seed
rm -rf "$run"
mkdir "$run"
sslcd_sim halv --case "$case" --seed "$seed" --out "$run/drive" > "$run/sim.txt"
replay() { python3 -B "$here/replay_keyframes.py" "$@"; }
replay config "$run/drive" "$imu" "$run"

started=()
stop() {
  for process in "${started[@]}"; do kill "$process" 2> /dev/null || true; done
  wait 2> /dev/null || true
}
trap stop EXIT
roscore -p "${ROS_MASTER_URI##*:}" > "$run/roscore.txt" 2>&1 &
started+=($!)
for _ in {1..60}; do
  python3 -c "import rosgraph; exit(not rosgraph.is_master_online())" && break
  sleep 0.5
done
LD_LIBRARY_PATH=$work/devel/camera_models/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} \
  "$node" "$run/vins.yaml" > "$run/node.txt" 2>&1 < <(tail -f --pid=$$ /dev/null) &
started+=($!)
replay publish "$run/drive" "$imu" "$hz"
# the optimiser looks for work every two seconds
until [[ -z $(find "$run/vio_loop.csv" -newermt "-8 seconds" 2> /dev/null) ]]; do sleep 1; done
kill -0 "${started[1]}" || { tail "$run/node.txt" >&2; echo "replay.sh: the node has ended" >&2; exit 1; }
cp "$run/vio_loop.csv" "$run/vins.csv"

replay tum "$run/drive" "$imu" "$run/vins.csv" "$run/result"
sslcd_run eval "$run/result" --groundtruth "$run/drive/groundtruth.txt" > "$run/eval.txt"
awk -v case="$case" -v imu="$imu" -v seed="$seed" '
  FILENAME ~ /vins.csv$/ { ++keyframes }
  /\[object loops\] loop [0-9]+ -> / { ++loops; if ($7 + 0 > 30) ++beyond; if ($9 + 0 > 20) ++far }
  /\[object loops\] loop at keyframe .* taken back/ { ++back }
  /\[object loops\] [0-9]+ of [0-9]+ accepted loops/ { used = $3; accepted = $5 }
  /odometry_ate_sim3_rmse_m/ { before = $2; next }
  /ate_sim3_rmse_m/ { after = $2 }
  END {
    printf "HALV-sim %d, seed %d, imu %d: %d keyframes; %d of %d accepted loops in the pose graph, ",
      case, seed, imu, keyframes, used, accepted
    printf "handed over: %d beyond 30 degrees, %d beyond 20 m, %d taken back; ", beyond, far, back
    printf "ATE %.3f -> %.3f m (x %.2f)\n", before, after, after / before
  }' "$run/vins.csv" "$run/node.txt" "$run/eval.txt"
