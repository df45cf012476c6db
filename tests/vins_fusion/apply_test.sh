#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# apply_test.sh APPLY STAND_IN: apply.sh does all or nothing, and does it once.
set -euo pipefail
apply=$1
stand_in=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "FAILED: $*" >&2; exit 1; }
fresh() { rm -rf "$work/checkout"; cp -r "$stand_in" "$work/checkout"; }
state() { (cd "$work/checkout" && find . -type f -exec sha256sum {} + | sort); }
# expect CODE TEXT: runs apply.sh
expect() {
  local code=0 said
  said=$(bash "$apply" "$work/checkout" 2>&1) || code=$?
  [[ $code -eq $1 ]] || fail "exit code $code instead of $1: $said"
  [[ $said == *"$2"* ]] || fail "'$2' is not in: $said"
}
# refuses TEXT: and changes nothing
refuses() {
  local before
  before=$(state)
  expect 1 "$1"
  [[ $(state) == "$before" ]] || fail "changed something"
}

fresh
expect 0 "object loops applied"
grep -q -- "-std=c++17" "$work/checkout/loop_fusion/CMakeLists.txt" || fail "not C++17"
! grep -q -- "-std=c++11" "$work/checkout/loop_fusion/CMakeLists.txt" || fail "still C++11"
[[ $(grep -c "first_looped_index = earliest_loop_index;  //" \
  "$work/checkout/loop_fusion/src/pose_graph.cpp") -eq 2 ]] || fail "not both optimisers"
before=$(state)
expect 0 "already applied"
[[ $(state) == "$before" ]] || fail "the second run changed something"
echo "// older" >> "$work/checkout/loop_fusion/src/object_loops/rig.cc"
expect 0 "already applied"
[[ $(state) == "$before" ]] || fail "the third run did not renew the files"

# each place in turn is not there
while IFS='|' read -r file text; do
  fresh
  grep -qF "$text" "$work/checkout/loop_fusion/$file" || fail "the stand-in lacks '$text'"
  TEXT=$text perl -i -ne 'print unless index($_, $ENV{TEXT}) >= 0' \
    "$work/checkout/loop_fusion/$file"
  refuses "$file: "
done <<'PLACES'
CMakeLists.txt|add_executable(loop_fusion_node
src/pose_graph.h|class PoseGraph
src/pose_graph.h| public:
src/pose_graph.cpp|cur_kf = getKeyFrame(cur_index);
src/pose_graph.cpp|problem.AddResidualBlock(cost_function, loss_function
src/pose_graph.cpp|problem.AddResidualBlock(loop_function, loss_function
src/pose_graph_node.cpp|PoseGraph posegraph;
src/pose_graph_node.cpp|posegraph.setIMUFlag(USE_IMU);
src/pose_graph_node.cpp|if (pose_msg != NULL)
src/pose_graph_node.cpp|posegraph.addKeyFrame(keyframe, 1);
PLACES

fresh
echo "void More() { cur_kf = getKeyFrame(cur_index); }" >> \
  "$work/checkout/loop_fusion/src/pose_graph.cpp"
refuses "is there 3 times instead of 2"

fresh
echo "// sslcd object loops" >> "$work/checkout/loop_fusion/src/pose_graph.h"
refuses "applied in part"

fresh
rm "$work/checkout/loop_fusion/src/pose_graph.cpp"
refuses "pose_graph.cpp: CHECKOUT must be the folder"

rm -rf "$work/checkout"
mkdir "$work/checkout"
refuses "CHECKOUT must be the folder"
code=0
bash "$apply" 2> /dev/null || code=$?
[[ $code -eq 2 ]] || fail "no argument: exit code $code"
echo "apply.sh: ok"
