// SPDX-License-Identifier: BSD-3-Clause
#include "report/viewpoint_recall.h"

#include <algorithm>
#include <cmath>

#include "eval/path.h"
#include "eval/revisits.h"
#include "report/loop_truth.h"

namespace sslcd {
namespace {

constexpr double kMostUnknown = .1;  // of the frames

std::size_t BinOf(double change_rad) {
  constexpr int kBins = 180 / kViewpointStepDeg;
  const int bin = static_cast<int>(std::abs(change_rad) * 180 / M_PI / kViewpointStepDeg);
  return static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1));
}

// The frames that have a true pose, turned so that up is -y as eval/revisits.h expects it.
struct TruePath {
  std::vector<Pose> poses;
  std::vector<double> at_m;   // path to each of them
  std::vector<int> of_frame;  // by frame; -1: none
};

TruePath TruePathOf(const RunView& run, const std::vector<int>& true_rows) {
  TruePath path;
  const Eigen::Matrix3d R_camera_page = Vec3(1, -1, -1).asDiagonal();
  const Eigen::Matrix3d R_level_world = R_camera_page * PageAxes(run.gravity);
  const Pose T_level_world(lie::SO3<double>(Eigen::Quaterniond(R_level_world)), Vec3::Zero());
  for (const int row : true_rows) {
    path.of_frame.push_back(row < 0 ? -1 : static_cast<int>(path.poses.size()));
    if (row >= 0) path.poses.push_back(T_level_world * run.truth.poses[std::size_t(row)]);
  }
  path.at_m = DistanceAlong(path.poses);
  return path;
}

const Pose& TruePoseOf(const TruePath& path, int frame) {
  return path.poses[std::size_t(path.of_frame[std::size_t(frame)])];
}

double TrueChange(const TruePath& path, const LoopClosure& loop) {
  return WrapAngle(HeadingOf(TruePoseOf(path, loop.query_frame)) -
                   HeadingOf(TruePoseOf(path, loop.match_frame)));
}

}  // namespace

std::vector<ViewpointCounts> ViewpointRecall(const RunView& run,
                                             const std::vector<int>& true_rows) {
  const auto unknown = std::count(true_rows.begin(), true_rows.end(), -1);
  if (true_rows.empty() || unknown >= kMostUnknown * static_cast<double>(true_rows.size()))
    return {};
  const TruePath path = TruePathOf(run, true_rows);
  std::vector<ViewpointCounts> bins(180 / kViewpointStepDeg);
  std::vector<double> right_at_m;
  for (const LoopClosure& loop : AcceptedLoops(run)) {
    const auto error = LoopError(run, true_rows, loop);
    if (!error) continue;
    ViewpointCounts& bin = bins[BinOf(TrueChange(path, loop))];
    ++bin.loops;
    if (!(*error < kRightLoopM)) continue;
    ++bin.right;
    right_at_m.push_back(path.at_m[std::size_t(path.of_frame[std::size_t(loop.query_frame)])]);
  }
  std::sort(right_at_m.begin(), right_at_m.end());
  RevisitOptions options;
  options.common = 0;
  for (const Revisit& revisit : FindRevisits(path.poses, {}, {}, options)) {
    ViewpointCounts& bin = bins[BinOf(revisit.viewpoint_rad)];
    ++bin.revisits;
    const auto near =
        std::lower_bound(right_at_m.begin(), right_at_m.end(), revisit.at_m - options.spacing_m);
    if (near != right_at_m.end() && *near <= revisit.at_m + options.spacing_m) ++bin.recognised;
  }
  return bins;
}

}  // namespace sslcd
