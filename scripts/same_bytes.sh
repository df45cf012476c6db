#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Checks that a change of structure changes no result: runs the reference sequences with sslcd_run
# of COMMIT and of the current build, and compares trajectory, map and loops byte by byte.
#   scripts/same_bytes.sh [COMMIT]     default: where this branch left main (git merge-base HEAD main)
# SSLCD_BUILD_DIR: build folder of sslcd_run (default build/release). SSLCD_DATA_DIR: real data
# (default ../shared/data). Sequences that are not there are named and skipped, but there must be
# one at least. SSLCD_SAME_BYTES_CMAKE: options of CMake (no blanks in one) for the reference, for
# another compiler or another optimisation of the same code:
#   SSLCD_SAME_BYTES_CMAKE='-DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_CXX_FLAGS_RELEASE=-O1' \
#     scripts/same_bytes.sh HEAD
# SSLCD_SAME_BYTES_DIR: the reference is built and run once per commit and kept there
# (default build/same_bytes). Exit code 1: something differs. Both runs are kept.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "${SSLCD_BUILD_DIR:-build/release}")
data=$(realpath -m "${SSLCD_DATA_DIR:-../shared/data}")
cache=$(realpath -m "${SSLCD_SAME_BYTES_DIR:-build/same_bytes}")
commit=$(git rev-parse --short=12 "${1:-$(git merge-base HEAD main)}^{commit}")
read -ra options <<<"${SSLCD_SAME_BYTES_CMAKE:-}"
reference=$cache/$commit
if ((${#options[@]})); then
  reference+=-$(printf '%s\n' "${options[@]}" | sha256sum | cut -c 1-8)
fi

# name | folder that must be there | arguments of `sslcd_run run`
sequences() {
  cat <<TABLE
victoria-park|$data/victoria-park|$data/victoria-park
poles-00|$data/kitti-odometry-poles/00|$data/kitti-odometry-poles/00
poles-05|$data/kitti-odometry-poles/05|$data/kitti-odometry-poles/05
forest-evo|$data/forest-evo-fwd|$data/forest-evo-fwd
kitti-0007|$data/kitti-tracking|$data/kitti-tracking --sequence 0007 --detections det_pointrcnn_car --odometry orbslam3_poses
halv-1|$reference/halv|$reference/halv
TABLE
}

run_all() {  # run_all SSLCD_RUN OUT
  local name folder arguments
  while IFS='|' read -r name folder arguments; do
    if [[ ! -d $folder ]]; then
      echo "skipped: no $folder" >&2
      continue
    fi
    # shellcheck disable=SC2086  # the table's arguments are words
    "$1" run $arguments --out "$2/$name" --quiet
  done < <(sequences)
}

if [[ ! -e $reference/done ]]; then
  echo "building the reference, $commit"
  rm -rf "$reference"
  source=$reference/source
  mkdir -p "$source"
  git archive "$commit" | tar -x -C "$source"
  (cd "$source" && cmake --preset release -DSSLCD_BUILD_TESTS=OFF "${options[@]}" &&
    cmake --build build/release -j "$(nproc)" --target sslcd_run sslcd_sim) >"$reference/build.log"
  apps=$source/build/release/apps
  "$apps/sslcd_sim" halv --case 1 --seed 7 --out "$reference/halv" >/dev/null
  run_all "$apps/sslcd_run" "$reference/runs"
  rm -rf "$source"
  touch "$reference/done"
fi

now=$cache/now
rm -rf "$now"
run_all "$build/apps/sslcd_run" "$now"
differ=0 compared=0
for folder in "$reference"/runs/*/; do
  name=$(basename "$folder")
  for file in trajectory_tum.txt map.json loops.csv; do
    compared=$((compared + 1))
    if ! cmp -s "$folder/$file" "$now/$name/$file"; then
      differ=$((differ + 1))
      echo "differs: $name/$file   (diff $folder$file $now/$name/$file)"
    fi
  done
done
((compared)) || { echo "nothing compared: no data at $data" >&2; exit 1; }
echo "same bytes as $commit: $((compared - differ)) of $compared files"
((differ == 0))
