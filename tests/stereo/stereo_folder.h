// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sslcd/core/error.h"
#include "sslcd/io/calib_reader.h"
#include "sslcd/io/pose_reader.h"
#include "sslcd/perception/opencv_image.h"
#include "sslcd/stereo/rig_check.h"

namespace sslcd {

/// Folders of stereo images with ground truth, for tests and benchmarks: KITTI's and HALV-sim's.
struct StereoFolder {
  StereoCamera camera;
  std::vector<std::string> left, right;
  std::vector<Pose> truth;  ///< of the reference camera; may be shorter than the images
};

inline std::vector<std::string> FilesIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// calib.txt with keys, or two 3x4 matrices in one row.
inline StereoCamera ReadStereoCamera(const std::string& path) {
  std::ifstream file(path);
  double P[24];
  int count = 0;
  while (count < 24 && file >> P[count]) ++count;
  if (count == 24) {
    Camera left;
    left.fx = P[0], left.fy = P[5], left.cx = P[2], left.cy = P[6];
    Camera right = left;
    right.offset.x() = P[15] / P[12];
    return MakeStereoCamera(left, right);
  }
  const Calibration calibration = ReadCalibration(path);
  if (!calibration.left || !calibration.right) throw Error(ErrorKind::kBadInput, path + ": has no P2 and P3");
  return MakeStereoCamera(*calibration.left, *calibration.right);
}

/// `poses`: ground truth; empty: groundtruth.txt in the folder.
inline StereoFolder OpenStereoFolder(const std::string& folder, const std::string& poses = "") {
  StereoFolder result;
  result.camera = ReadStereoCamera(folder + "/calib.txt");
  const bool kitti_names = std::filesystem::exists(folder + "/image_2");
  result.left = FilesIn(folder + (kitti_names ? "/image_2" : "/image_l"));
  result.right = FilesIn(folder + (kitti_names ? "/image_3" : "/image_r"));
  result.truth = ReadTrajectory(poses.empty() ? folder + "/groundtruth.txt" : poses).poses;
  return result;
}

inline PairLoader Loader(const StereoFolder& folder) {
  const auto read = [](const std::string& path) {
    const cv::Mat image = cv::imread(path, cv::IMREAD_ANYCOLOR);
    return Image{{image.data, image.data + image.total() * image.elemSize()}, image.cols, image.rows, image.channels()};
  };
  return [&folder, read](std::size_t i) { return std::pair(read(folder.left[i]), read(folder.right[i])); };
}

}  // namespace sslcd
