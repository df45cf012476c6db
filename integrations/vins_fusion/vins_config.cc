// SPDX-License-Identifier: BSD-3-Clause
#include "vins_config.h"

#include <opencv2/core.hpp>

#include "sslcd/core/error.h"

namespace sslcd::vins {
namespace {

cv::FileStorage Open(const std::string& path) {
  try {
    cv::FileStorage file(path, cv::FileStorage::READ);
    if (file.isOpened()) return file;
  } catch (const cv::Exception& error) {
    throw Error(ErrorKind::kBadInput, path + ": " + error.what());
  }
  throw Error(ErrorKind::kBadInput, path + ": cannot be opened");
}

std::string Beside(const std::string& path, const std::string& name) {
  const std::size_t slash = path.find_last_of('/');
  return name.empty() || name[0] == '/' || slash == std::string::npos
             ? name
             : path.substr(0, slash + 1) + name;
}

Pose ReadExtrinsics(const cv::FileStorage& file, const std::string& path) {
  cv::Mat matrix;
  file["body_T_cam0"] >> matrix;
  if (matrix.rows != 4 || matrix.cols != 4)
    throw Error(ErrorKind::kBadInput, path + ": body_T_cam0 is no 4x4 matrix");
  matrix.convertTo(matrix, CV_64F);
  Eigen::Matrix3d R;
  Vec3 t;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) R(row, col) = matrix.at<double>(row, col);
    t[row] = matrix.at<double>(row, 3);
  }
  const auto pose = RigidFromMatrix(R, t);
  if (!pose) throw Error(ErrorKind::kBadInput, path + ": body_T_cam0 is no rigid transform");
  return *pose;
}

bool HasDistortion(const cv::FileNode& node) {
  for (const char* key : {"k1", "k2", "p1", "p2"})
    if (!node[key].empty() && static_cast<double>(node[key]) != 0) return true;
  return false;
}

// None, with a note, if it is no camera of sslcd's.
std::optional<Camera> ReadCamera(const std::string& path, std::vector<std::string>& notes) {
  const cv::FileStorage file = Open(path);
  const std::string model = static_cast<std::string>(file["model_type"]);
  const cv::FileNode projection = file["projection_parameters"];
  if (model != "PINHOLE" || HasDistortion(file["distortion_parameters"])) {
    notes.push_back(path + ": no pinhole without distortion, so 2D boxes are not used");
    return std::nullopt;
  }
  Camera camera;
  camera.fx = projection["fx"];
  camera.fy = projection["fy"];
  camera.cx = projection["cx"];
  camera.cy = projection["cy"];
  camera.width = file["image_width"];
  camera.height = file["image_height"];
  return camera;
}

}  // namespace

VinsConfig ReadVinsConfig(const std::string& path) {
  const cv::FileStorage file = Open(path);
  VinsConfig config;
  if (file["imu"].empty()) throw Error(ErrorKind::kBadInput, path + ": no key 'imu'");
  config.rig.imu = static_cast<int>(file["imu"]) != 0;
  config.rig.T_body_cam = ReadExtrinsics(file, path);
  const std::string camera = static_cast<std::string>(file["cam0_calib"]);
  if (!camera.empty()) config.rig.camera = ReadCamera(Beside(path, camera), config.notes);
  config.detections = static_cast<std::string>(file["sslcd_detections"]);
  if (!config.detections.empty()) config.detections = Beside(path, config.detections);
  return config;
}

}  // namespace sslcd::vins
