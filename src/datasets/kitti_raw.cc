// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "datasets/dataset_reader.h"
#include "datasets/oxts.h"
#include "formats/files.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

bool LooksLikeKittiRaw(const std::string& folder) {
  const fs::path root = folder;
  return IsFolder(root / "oxts" / "data") || IsFile(root / "tracklet_labels.xml");
}

DatasetLayout FindKittiRaw(const std::string& folder, const std::string&) {
  const fs::path root = folder;
  DatasetLayout layout;
  layout.name = LastName(folder);
  layout.odometry = IfFolder(root / "oxts" / "data");
  layout.odometry_is_truth = true;
  layout.odometry_file = "oxts/data";
  layout.detections = IfFile(root / "tracklet_labels.xml");
  layout.detections_file = "tracklet_labels.xml";
  layout.times = IfFile(root / "oxts" / "timestamps.txt");
  layout.read_times = ReadTimestamps;
  layout.images = IfFolder(root / "image_02" / "data");
  layout.images_right = IfFolder(root / "image_03" / "data");
  layout.find_image = NumberedImages(10);
  for (const fs::path& place : {root / "..", root}) {
    if (IsFile(place / "calib_cam_to_cam.txt")) layout.calib = place.string();
  }
  layout.read_calibration = ReadRawCalibration;
  return layout;
}

}  // namespace

DatasetReader KittiRawReader() {
  return {"kitti-raw", "a KITTI raw drive, with oxts/data/ or tracklet_labels.xml",
          LooksLikeKittiRaw, nullptr, FindKittiRaw};
}

}  // namespace sslcd
