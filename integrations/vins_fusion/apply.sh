#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# apply.sh CHECKOUT: adds object loops to the loop_fusion of a VINS-Fusion checkout. Copies the files
# of this folder to loop_fusion/src/object_loops and inserts the calls (docs/vins_fusion.md). Either
# all of it is done or nothing: if a place is not found, it says which and leaves with 1.
set -euo pipefail

[[ $# -eq 1 ]] || { echo "usage: apply.sh CHECKOUT" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mark="sslcd object loops"
root=$1/loop_fusion
edited=(CMakeLists.txt src/pose_graph.h src/pose_graph.cpp src/pose_graph_node.cpp)
ours=$root/src/object_loops

fail() { echo "apply.sh: $*; nothing was changed" >&2; exit 1; }

copy_ours() {
  mkdir -p "$ours"
  cp "$here"/*.h "$here"/*.cc "$ours/"
}

marked=0
for file in "${edited[@]}"; do
  [[ -f $root/$file ]] || fail "no $root/$file: CHECKOUT must be the folder that holds loop_fusion"
  ! grep -q "$mark" "$root/$file" || marked=$((marked + 1))
done
if [[ $marked -eq ${#edited[@]} ]]; then
  copy_ours
  echo "already applied; the files in $ours are those of this sslcd now"
  exit 0
fi
[[ $marked -eq 0 ]] || fail "applied in part: restore loop_fusion first (git checkout loop_fusion)"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/src"
for file in "${edited[@]}"; do cp "$root/$file" "$work/$file"; done
done_text=""

# insert FILE before|after COUNT ANCHOR LINES [FROM]: puts LINES at each line that contains ANCHOR,
# which have to be COUNT; with FROM, at the first such line behind one that contains FROM.
insert() {
  local file=$1 where=$2 count=$3 anchor=$4 lines=$5 from=${6:-}
  local found
  found=$(WHERE=$where ANCHOR=$anchor LINES_=$lines FROM=$from MARK="// $mark" \
    OUT="$work/next" awk '
    BEGIN { n = split(ENVIRON["LINES_"], line, "\n"); open = ENVIRON["FROM"] == "" }
    function put(indent,   i) {
      for (i = 1; i <= n; ++i) print indent line[i] "  " ENVIRON["MARK"] > ENVIRON["OUT"]
    }
    {
      if (!open && index($0, ENVIRON["FROM"])) open = 1
      hit = open && index($0, ENVIRON["ANCHOR"])
      if (hit && ENVIRON["FROM"] != "" && found) hit = 0
      match($0, /^[ \t]*/)
      indent = substr($0, 1, RLENGTH)
      if (hit) ++found
      if (hit && ENVIRON["WHERE"] == "before") put(indent)
      print > ENVIRON["OUT"]
      if (hit && ENVIRON["WHERE"] == "after") put(indent)
    }
    END { print found + 0 }' "$work/$file")
  [[ $found -eq $count ]] ||
    fail "$root/$file: '$anchor' is there $found times instead of $count"
  mv "$work/next" "$work/$file"
  done_text+="  $file: $where '$anchor'"$'\n'
}

node=src/pose_graph_node.cpp
insert $node after 1 'PoseGraph posegraph;' 'sslcd::vins::LoopFusion object_loops(posegraph);'
insert $node after 1 'posegraph.setIMUFlag(USE_IMU);' 'object_loops.Start(config_file);'
insert $node before 1 'if (pose_msg != NULL)' 'object_loops.TakeLoops();'
insert $node after 1 'posegraph.addKeyFrame(keyframe, 1);' \
  'object_loops.AddKeyFrame(*keyframe, tic, qic);'

insert src/pose_graph.h before 1 'class PoseGraph' '#include "object_loops/loop_fusion.h"'
insert src/pose_graph.h after 1 'public:' \
  $'friend class sslcd::vins::LoopFusion;\nsslcd::vins::LoopFusion* object_loops = nullptr;' \
  'class PoseGraph'

# A loop may have come to an older keyframe since the optimiser has read where to begin.
insert src/pose_graph.cpp after 2 'cur_kf = getKeyFrame(cur_index);' \
  'first_looped_index = earliest_loop_index;'
insert src/pose_graph.cpp before 1 'problem.AddResidualBlock(cost_function, loss_function' \
  'if (object_loops) cost_function = object_loops->WeighFourDof(**it, cost_function);'
insert src/pose_graph.cpp before 1 'problem.AddResidualBlock(loop_function, loss_function' \
  'if (object_loops) loop_function = object_loops->WeighSixDof(**it, loop_function);'

grep -q 'add_executable(loop_fusion_node' "$work/CMakeLists.txt" ||
  fail "$root/CMakeLists.txt: no 'add_executable(loop_fusion_node'"
sed -i -E "s/-std=(c|gnu)\+\+(98|03|0x|11|1y|14)\b/-std=c++17/" "$work/CMakeLists.txt"
{
  echo
  echo "# $mark"
  echo "find_package(sslcd REQUIRED)"
  echo "target_sources(loop_fusion_node PRIVATE"
  for source in "$here"/*.cc; do echo "    src/object_loops/$(basename "$source")"; done
  echo "    )"
  echo "target_include_directories(loop_fusion_node PRIVATE src)"
  echo "target_link_libraries(loop_fusion_node sslcd::sslcd)"
} >> "$work/CMakeLists.txt"

copy_ours
for file in "${edited[@]}"; do cp "$work/$file" "$root/$file"; done
echo "object loops applied to $root"
printf '%s' "$done_text"
echo "  CMakeLists.txt: C++17, sslcd, the files in src/object_loops"
echo "next: sslcd_detections: \"FOLDER\" in VINS's configuration, or a detector (docs/vins_fusion.md)"
