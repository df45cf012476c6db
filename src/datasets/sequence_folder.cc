// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/sequence_folder.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "datasets/image_folder.h"
#include "formats/files.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

struct ImagePair {
  const char *left, *right;
  CameraPair cameras;
};
constexpr std::array<ImagePair, 4> kImagePairs = {{{"image_2", "image_3", CameraPair::kColour},
                                                   {"image_0", "image_1", CameraPair::kGrey},
                                                   {"image_l", "image_r", CameraPair::kGrey},
                                                   {"left", "right", CameraPair::kGrey}}};

bool HasImages(const fs::path& folder) {
  const std::vector<std::string> names = FileNames(folder);
  return std::any_of(names.begin(), names.end(), IsImageName);
}

bool LooksLikeSequenceFolder(const std::string& folder) {
  const fs::path root = folder;
  const auto names = {"odometry.txt", "detections.txt", "times.txt", "sequence.yaml"};
  return std::any_of(kImagePairs.begin(), kImagePairs.end(),
                     [&](const ImagePair& pair) { return IsFolder(root / pair.left); }) ||
         std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return IsFile(root / name); });
}

}  // namespace

DatasetLayout FindSequenceFolder(const std::string& folder) {
  const fs::path root = folder;
  DatasetLayout layout;
  layout.name = LastName(folder);
  layout.odometry = IfFile(root / "odometry.txt");
  layout.odometry_file = "odometry.txt";
  layout.detections = IfFile(root / "detections.txt");
  if (layout.detections.empty()) layout.detections = IfFolder(root / "detections");
  layout.detections_file = "detections.txt";
  layout.groundtruth = IfFile(root / "groundtruth.txt");
  layout.times = IfFile(root / "times.txt");
  layout.calib = IfFile(root / "calib.txt");
  layout.sequence_yaml = IfFile(root / "sequence.yaml");
  for (const CueRow& row : kCueRows) layout.appearance[row.cue] = IfFile(root / row.file);
  const auto complete =
      std::find_if(kImagePairs.begin(), kImagePairs.end(), [&](const ImagePair& pair) {
        return HasImages(root / pair.left) && HasImages(root / pair.right);
      });
  const auto one = std::find_if(kImagePairs.begin(), kImagePairs.end(),
                                [&](const ImagePair& pair) { return HasImages(root / pair.left); });
  const ImagePair& pair = complete != kImagePairs.end() ? *complete
                          : one != kImagePairs.end()    ? *one
                                                        : kImagePairs[0];
  layout.images = IfFolder(root / pair.left);
  layout.images_right = IfFolder(root / pair.right);
  layout.read_calibration = [cameras = pair.cameras](const std::string& calib) {
    return ReadCalibration(calib, cameras);
  };
  return layout;
}

DatasetReader SequenceFolderReader() {
  return {"sequence",
          "a folder with times.txt, odometry.txt, detections.txt, sequence.yaml, left/, image_2/, "
          "image_0/ or image_l/",
          LooksLikeSequenceFolder, nullptr,
          [](const std::string& folder, const std::string&) { return FindSequenceFolder(folder); }};
}

}  // namespace sslcd
