// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/groundtruth.h"

#include <algorithm>

namespace sslcd {
namespace {

constexpr double kSameTime = 0.01;  // [s], of MatchByStamp, which pairs the poses later

bool StampsMeet(const std::vector<double>& truth, const std::vector<Frame>& frames) {
  return std::any_of(frames.begin(), frames.end(), [&truth](const Frame& frame) {
    const auto next = std::lower_bound(truth.begin(), truth.end(), frame.stamp - kSameTime);
    return next != truth.end() && *next <= frame.stamp + kSameTime;
  });
}

std::string Seconds(double first, double last) {
  return std::to_string(first) + " to " + std::to_string(last) + " s";
}

Trajectory ByRow(Trajectory truth, const std::vector<Frame>& frames) {
  truth.poses.resize(std::min(truth.size(), frames.size()));
  truth.stamps.clear();
  for (std::size_t i = 0; i < truth.size(); ++i) truth.stamps.push_back(frames[i].stamp);
  return truth;
}

}  // namespace

std::optional<Trajectory> GroundtruthOfFrames(const PoseFile& file, const std::string& path,
                                              const std::vector<Frame>& frames,
                                              std::size_t frames_in_file,
                                              std::vector<std::string>& warnings) {
  const Trajectory& truth = file.trajectory;
  if (truth.poses.empty()) {
    warnings.push_back(path + ": has no poses; it is not used");
    return std::nullopt;
  }
  const bool one_per_frame = truth.size() == frames_in_file;
  if (file.format == PoseFormat::kKitti) {
    if (!one_per_frame)
      warnings.push_back(path + ": " + std::to_string(truth.size()) + " ground-truth poses for " +
                         std::to_string(frames_in_file) + " frames; row i is taken as frame i");
    return ByRow(truth, frames);
  }
  if (frames.empty() || StampsMeet(truth.stamps, frames)) return truth;
  const std::string clocks =
      path + ": no stamp (" + Seconds(truth.stamps.front(), truth.stamps.back()) +
      ") is of the time of a frame (" + Seconds(frames.front().stamp, frames.back().stamp) + ")";
  if (one_per_frame) {
    warnings.push_back(clocks + "; there are as many as frames, so row i is taken as frame i");
    return ByRow(truth, frames);
  }
  warnings.push_back(clocks + "; it is not used: give both the same clock, or one pose per frame");
  return std::nullopt;
}

}  // namespace sslcd
