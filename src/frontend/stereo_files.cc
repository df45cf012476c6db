// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/stereo_files.h"

#include <algorithm>

#include "formats/number_text.h"
#include "sslcd/core/log.h"
#include "sslcd/ground/ground_alignment.h"

namespace sslcd {
namespace {

std::string Pixels(double value) { return FixedNumber(value, 3) + " px"; }

void LogRig(const RigCheck& check, const StereoCamera& camera) {
  const std::string rows =
      "rows of left and right images differ by " + Pixels(check.row_error.value());
  if (check.disparity_at_infinity != camera.disparity_at_infinity) {
    Log(LogLevel::kWarning, "calibration is off: " + rows +
                                ". The motion of points gives a disparity at infinity of " +
                                Pixels(check.disparity_at_infinity) + ", which replaces " +
                                Pixels(camera.disparity_at_infinity) +
                                "; vision.odometry.calibrate: false keeps the calibration");
  } else if (check.unsure) {
    Log(LogLevel::kWarning, "calibration is off: " + rows +
                                ", but no frames show the error of the columns, so distances may "
                                "be wrong by some per cent");
  } else {
    Log(LogLevel::kInfo, rows);
  }
}

}  // namespace

bool StereoFiles::HasPairs() const {
  return std::any_of(paths.begin(), paths.end(),
                     [](const auto& pair) { return !pair.first.empty() && !pair.second.empty(); });
}

StereoFiles StereoFilesOf(const std::vector<Frame>& frames,
                          std::function<Image(const std::string&)> load,
                          std::function<bool()> stop) {
  StereoFiles files{{}, std::move(load), std::move(stop)};
  for (const Frame& frame : frames) files.paths.emplace_back(frame.image_left, frame.image_right);
  return files;
}

RigCheck CheckRig(const StereoFiles& files, const StereoCamera& camera,
                  const StereoOdometryOptions& options) {
  std::pair<int, int> size(0, 0);  // of the first pair
  const auto load = [&](std::size_t i) -> std::optional<std::pair<Image, Image>> {
    const auto& [left_path, right_path] = files.paths[i];
    if (files.stopped() || left_path.empty() || right_path.empty()) return std::nullopt;
    std::pair<Image, Image> pair{files.load(left_path), files.load(right_path)};
    const auto& [left, right] = pair;
    if (left.empty() || right.empty())
      Log(LogLevel::kWarning, (left.empty() ? left_path : right_path) +
                                  ": no image that can be read; the check of the calibration goes "
                                  "without its frame");
    if (left.empty() || left.width != right.width || left.height != right.height)
      return std::nullopt;
    if (size.first == 0) size = {left.width, left.height};
    if (size != std::pair(left.width, left.height)) return std::nullopt;
    return pair;
  };
  const RigCheck check = CheckRig(camera, files.paths.size(), load, options);
  if (check.row_error && !files.stopped()) LogRig(check, camera);
  return check;
}

std::optional<double> AlignmentRange(const StereoFiles& files, const Camera& left,
                                     double height_m) {
  for (const auto& pair : files.paths) {
    if (pair.first.empty()) continue;
    const Image image = files.load(pair.first);
    if (!image.empty()) return AlignmentRange(left, image.height, height_m);
  }
  return std::nullopt;
}

}  // namespace sslcd
