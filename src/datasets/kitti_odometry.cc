// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "datasets/sequence_folder.h"
#include "formats/files.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

bool LooksLikeKittiOdometry(const std::string& folder) {
  return IsFolder(fs::path(folder) / "sequences");
}

std::set<std::string> KittiOdometrySequences(const std::string& folder) {
  const fs::path sequences = fs::path(folder) / "sequences";
  std::set<std::string> names;
  for (const std::string& name : FileNames(sequences)) {
    if (IsFolder(sequences / name)) names.insert(name);
  }
  return names;
}

DatasetLayout FindKittiOdometry(const std::string& folder, const std::string& sequence) {
  const fs::path root = folder;
  DatasetLayout layout = FindSequenceFolder(root / "sequences" / sequence);
  layout.groundtruth = IfFile(root / "poses" / (sequence + ".txt"));
  return layout;
}

}  // namespace

DatasetReader KittiOdometryReader() {
  return {"kitti-odometry", "KITTI odometry, with sequences/", LooksLikeKittiOdometry,
          KittiOdometrySequences, FindKittiOdometry};
}

}  // namespace sslcd
