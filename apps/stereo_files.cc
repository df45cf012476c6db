// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_files.h"

#include "console.h"
#include "image_loader.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "sslcd/stereo/ground_alignment.h"

namespace sslcd::apps {

StereoFiles StereoFilesOf(const Dataset& dataset) {
  StereoFiles files;
  for (const Frame& frame : dataset.frames) files.emplace_back(frame.image_left, frame.image_right);
  return files;
}

StereoCamera StereoCameraOf(const Dataset& dataset) {
  try {
    return MakeStereoCamera(*dataset.camera, *dataset.camera_right);
  } catch (const Error& error) {
    throw Error(error.kind(), {dataset.name}, error.what());
  }
}

RigCheck CheckRigOf(const StereoFiles& files, const StereoCamera& camera,
                    const StereoOdometryOptions& options) {
  std::pair<int, int> size(0, 0);  // of the first pair; others are left out
  const auto load = [&](std::size_t i) -> std::optional<std::pair<Image, Image>> {
    if (Interrupted() || files[i].first.empty() || files[i].second.empty()) return std::nullopt;
    std::pair<Image, Image> pair{LoadImage(files[i].first), LoadImage(files[i].second)};
    const auto& [left, right] = pair;
    if (left.empty() || left.width != right.width || left.height != right.height)
      return std::nullopt;
    if (size.first == 0) size = {left.width, left.height};
    if (size != std::pair(left.width, left.height)) return std::nullopt;
    return pair;
  };
  const RigCheck check = CheckRig(camera, files.size(), load, options);
  if (!check.row_error || Interrupted()) return check;
  const std::string rows =
      "rows of left and right images differ by " + Number("%.3f", *check.row_error) + " px";
  if (check.disparity_at_infinity != camera.disparity_at_infinity) {
    Log(LogLevel::kWarning,
        "calibration is off: " + rows + ". As points move, the disparity at infinity is " +
            Number("%.3f", check.disparity_at_infinity) + " px, which is used instead of " +
            Number("%.3f", camera.disparity_at_infinity) +
            "; vision.odometry.calibrate: false leaves it");
  } else if (check.unsure) {
    Log(LogLevel::kWarning,
        "calibration is off: " + rows +
            ", and no frames tell by how much columns do, so distances may be some per cent off");
  } else {
    Log(LogLevel::kInfo, rows);
  }
  return check;
}

std::optional<double> SpotAheadOf(const StereoFiles& files, const Camera& camera, double height_m) {
  for (const auto& [left, right] : files) {
    if (left.empty()) continue;
    const Image image = LoadImage(left);
    if (!image.empty()) return SpotAhead(camera, image.height, height_m);
  }
  return std::nullopt;
}

}  // namespace sslcd::apps
