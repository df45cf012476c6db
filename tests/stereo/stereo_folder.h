// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "formats/calib.h"
#include "sslcd/core/error.h"
#include "sslcd/formats/poses.h"
#include "sslcd/perception/opencv_image.h"
#include "sslcd/visual_odometry/odometry.h"

namespace sslcd {

/// Folders of stereo images with ground truth, for tests and benchmarks: KITTI's and HALV-sim's.
struct StereoFolder {
  StereoCamera camera;
  std::vector<std::string> left, right;
  std::vector<Pose> truth;  ///< of the reference camera; may be shorter than the images
};

inline std::vector<std::string> FilesIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// `poses`: ground truth; empty: groundtruth.txt in the folder.
inline StereoFolder OpenStereoFolder(const std::string& folder, const std::string& poses = "") {
  StereoFolder result;
  const bool colour = std::filesystem::exists(folder + "/image_2");
  const Calibration calibration =
      ReadCalibration(folder + "/calib.txt", colour ? CameraPair::kColour : CameraPair::kGrey);
  if (!calibration.right)
    throw Error(ErrorKind::kBadInput, folder + "/calib.txt: has no right camera");
  result.camera = MakeStereoCamera(*calibration.left, *calibration.right);
  result.left = FilesIn(folder + (colour ? "/image_2" : "/image_l"));
  result.right = FilesIn(folder + (colour ? "/image_3" : "/image_r"));
  result.truth = ReadTrajectory(poses.empty() ? folder + "/groundtruth.txt" : poses).poses;
  return result;
}

inline PairLoader Loader(const StereoFolder& folder) {
  const auto read = [](const std::string& path) {
    const cv::Mat image = cv::imread(path, cv::IMREAD_ANYCOLOR);
    return Image{{image.data, image.data + image.total() * image.elemSize()},
                 image.cols,
                 image.rows,
                 image.channels()};
  };
  return [&folder, read](std::size_t i) {
    return std::pair(read(folder.left[i]), read(folder.right[i]));
  };
}

}  // namespace sslcd
