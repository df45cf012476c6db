// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/map_json.h"
#include "formats/run_json.h"
#include "report/palette.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Images of two landmarks that a loop has matched, seen near its two cameras.
struct PairCrops {
  std::size_t loop = 0, pair = 0;  ///< LoopClosure::pairs[pair] of RunView::loops[loop]
  std::string query_jpeg, match_jpeg;
};

/// A run folder, read back to be looked at.
struct RunView {
  std::string folder;
  std::optional<RunRecord> record;  ///< none: written by an earlier version
  MapFile map;                      ///< confirmed objects only
  GravityFrame gravity;             ///< of the map's up axis
  Trajectory trajectory, odometry;  ///< T_world_cam, row i is frame i
  /// rigidly aligned to the trajectory (SE(3), as in `ate_se3`); empty: none was given
  Trajectory truth;
  std::vector<LoopClosure> loops;  ///< all attempts
  std::string metrics_json, timing_json, config_yaml;
  /// for reports; ReadRun leaves them empty, who can read images fills them
  std::vector<PairCrops> crops;
  std::string crops_note;  ///< why there are none, or not of all loops
};

/// Reads the folder. `groundtruth` is a pose file to compare with; empty: the poses that the run
/// was compared with, if any. Throws Error(kBadInput) if a file is missing or wrong, or if the
/// files are of two runs (CheckRunFolder), and Error(kNoSolution) if no true pose has the time of a
/// frame.
RunView ReadRun(const std::string& folder, const std::string& groundtruth = "");

/// Throws Error(kBadInput) if the run has no poses, or another number of them than its odometry.
void RequirePoses(const RunView& run);

/// R_page_world, for worlds that are shown with x to the right, y up and z towards the viewer of a
/// map: the axes of three.js and glTF.
Eigen::Matrix3d PageAxes(const GravityFrame& gravity);

/// Whether objects of the label look the same from all sides, like trees and poles.
bool IsRound(const RunView& run, const std::string& label);

/// The colour of each label of the map.
std::map<std::string, Colour> LabelColours(const RunView& run);

/// The accepted loops in order of their query frames, without those whose frames are not in the
/// trajectory.
std::vector<LoopClosure> AcceptedLoops(const RunView& run);

}  // namespace sslcd
