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
  return IsFolder(root / "oxts" / "data") || IsFile(root / "tracklet_labels.xml") ||
         IsFolder(root / "image_02" / "data") || IsFolder(root / "image_00" / "data");
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
  const bool grey = !IsFolder(root / "image_02" / "data") && IsFolder(root / "image_00" / "data");
  const fs::path left = root / (grey ? "image_00" : "image_02");
  layout.images = IfFolder(left / "data");
  layout.images_right = IfFolder(root / (grey ? "image_01" : "image_03") / "data");
  for (const fs::path& place : {root / "oxts", left})
    if (layout.times.empty()) layout.times = IfFile(place / "timestamps.txt");
  layout.read_times = ReadTimestamps;
  for (const fs::path& place : {root / "..", root}) {
    if (IsFile(place / "calib_cam_to_cam.txt")) layout.calib = place.string();
  }
  layout.read_calibration = [grey](const std::string& place) {
    return ReadRawCalibration(place, grey ? CameraPair::kGrey : CameraPair::kColour);
  };
  return layout;
}

}  // namespace

DatasetReader KittiRawReader() {
  return {
      "kitti-raw",
      "a KITTI raw drive, with oxts/data/, tracklet_labels.xml, image_02/data/ or image_00/data/",
      LooksLikeKittiRaw, nullptr, FindKittiRaw};
}

}  // namespace sslcd
