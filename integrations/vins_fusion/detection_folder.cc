// SPDX-License-Identifier: BSD-3-Clause
#include "detection_folder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd::vins {

DetectionFolder::DetectionFolder(const std::string& path) {
  DatasetRequest request;
  request.path = path;
  request.format = "sequence";
  request.odometry_policy = PartPolicy::kIgnored;
  Dataset dataset = LoadDataset(request);
  if (dataset.frames.empty()) throw Error(ErrorKind::kBadInput, path + ": no frames");
  frames_ = std::move(dataset.frames);
  labels_ = std::move(dataset.labels);
}

const Frame* DetectionFolder::Find(double stamp) const {
  const auto at =
      std::lower_bound(frames_.begin(), frames_.end(), stamp - kTolerance,
                       [](const Frame& frame, double earliest) { return frame.stamp < earliest; });
  return at != frames_.end() && at->stamp <= stamp + kTolerance ? &*at : nullptr;
}

std::vector<Detection> DetectionFolder::At(double stamp) const {
  const Frame* frame = Find(stamp);
  return frame ? frame->detections : std::vector<Detection>();
}

}  // namespace sslcd::vins
