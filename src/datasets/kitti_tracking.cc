// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "datasets/dataset_reader.h"
#include "formats/files.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

constexpr ImageSize kImageSize = {1242, 375};  // a few sequences differ by some pixels

bool LooksLikeKittiTracking(const std::string& folder) {
  return IsFolder(fs::path(folder) / "calib") || IsFolder(fs::path(folder) / "label_02");
}

std::set<std::string> KittiTrackingSequences(const std::string& folder) {
  std::set<std::string> names;
  for (const char* part : {"calib", "label_02", "oxts", "image_02"}) {
    for (const std::string& name : FileNames(fs::path(folder) / part))
      names.insert(name.substr(0, name.find('.')));
  }
  return names;
}

DatasetLayout FindKittiTracking(const std::string& folder, const std::string& sequence) {
  const fs::path root = folder;
  const std::string file = sequence + ".txt";
  DatasetLayout layout;
  layout.name = sequence;
  layout.groundtruth = IfFile(root / "oxts" / file);
  layout.groundtruth_boxes = IfFile(root / "label_02" / file);
  layout.calib = IfFile(root / "calib" / file);
  layout.images = IfFolder(root / "image_02" / sequence);
  layout.images_right = IfFolder(root / "image_03" / sequence);
  layout.image_size = kImageSize;
  return layout;
}

}  // namespace

DatasetReader KittiTrackingReader() {
  return {"kitti-tracking", "KITTI tracking, with calib/ or label_02/", LooksLikeKittiTracking,
          KittiTrackingSequences, FindKittiTracking};
}

}  // namespace sslcd
