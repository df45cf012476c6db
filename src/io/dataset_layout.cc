// SPDX-License-Identifier: BSD-3-Clause
#include "io/dataset_layout.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "io/files.h"
#include "sslcd/core/error.h"
#include "sslcd/io/text_rows.h"

namespace sslcd {
namespace {

std::string IfFile(const std::string& path) { return IsFile(path) ? path : ""; }
std::string IfFolder(const std::string& path) { return IsFolder(path) ? path : ""; }

std::string LastName(const std::string& folder) {
  const auto path = std::filesystem::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

std::string Stem(const std::string& name) { return name.substr(0, name.find('.')); }

struct ImagePair {
  const char *left, *right;
  CameraPair cameras;
};
constexpr std::array<ImagePair, 3> kImagePairs = {{{"/image_2", "/image_3", CameraPair::kColour},
                                                   {"/image_0", "/image_1", CameraPair::kGrey},
                                                   {"/image_l", "/image_r", CameraPair::kGrey}}};

bool HasImages(const std::string& folder) {
  return IsFolder(folder) &&
         (!NumberedFiles(folder, ".png").empty() || !NumberedFiles(folder, ".jpg").empty());
}

bool LooksLikeSequence(const std::string& folder) {
  const auto names = {"odometry.txt", "detections.txt", "times.txt", "sequence.yaml"};
  return std::any_of(kImagePairs.begin(), kImagePairs.end(),
                     [&](const ImagePair& pair) { return IsFolder(folder + pair.left); }) ||
         std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return IsFile(folder + "/" + name); });
}
bool LooksLikeRaw(const std::string& folder) {
  return IsFolder(folder + "/oxts/data") || IsFile(folder + "/tracklet_labels.xml");
}
bool LooksLikeOdometry(const std::string& folder) { return IsFolder(folder + "/sequences"); }
bool LooksLikeTracking(const std::string& folder) {
  return IsFolder(folder + "/calib") || IsFolder(folder + "/label_02");
}

DatasetFormat Guess(const std::string& root) {
  if (LooksLikeSequence(root)) return DatasetFormat::kSequence;
  if (LooksLikeOdometry(root)) return DatasetFormat::kKittiOdometry;
  if (LooksLikeRaw(root)) return DatasetFormat::kKittiRaw;
  if (LooksLikeTracking(root)) return DatasetFormat::kKittiTracking;
  std::string message =
      "not a dataset folder that is known. Looked for: sequence folder (times.txt, odometry.txt, "
      "detections.txt, "
      "sequence.yaml, image_2/, image_0/ or image_l/), KITTI odometry (sequences/), KITTI raw "
      "drive (oxts/data/ or "
      "tracklet_labels.xml), "
      "KITTI tracking (calib/ or label_02/)";
  std::vector<std::string> inside;
  for (const std::string& name : FileNames(root)) {
    const std::string folder = root + "/" + name;
    if (LooksLikeSequence(folder) || LooksLikeRaw(folder)) inside.push_back(name);
  }
  if (!inside.empty()) message += ". There are sequences inside, name one: " + Join(inside);
  throw Error(ErrorKind::kBadInput, {root}, message);
}

/// Checks `wanted` against what there is; an empty one stands for the only one.
std::string ChooseSequence(const std::string& root, const std::string& wanted,
                           const std::set<std::string>& available) {
  if (available.count(wanted) > 0) return wanted;
  const std::string list = Join({available.begin(), available.end()});
  if (!wanted.empty())
    throw Error(ErrorKind::kBadInput, {root}, "no sequence '" + wanted + "'; there are: " + list);
  if (available.size() != 1)
    throw Error(ErrorKind::kUsage, {root}, "name a sequence (--sequence); there are: " + list);
  return *available.begin();
}

/// A path of the request: relative to the dataset or to the current folder; in a folder, the
/// sequence's file.
std::string Resolve(const std::string& root, const std::string& path, const std::string& sequence,
                    const char* what) {
  for (const std::string& candidate : {(std::filesystem::path(root) / path).string(), path}) {
    if (IsFile(candidate)) return candidate;
    if (!IsFolder(candidate)) continue;
    const std::string file = sequence + ".txt";
    if (sequence.empty()) return candidate;
    if (IsFile(candidate + "/" + file)) return candidate + "/" + file;
    // Files named like other sequences; those of frames (000000.txt) have longer names.
    std::vector<std::string> others;
    for (const std::string& name : FileNames(candidate)) {
      if (name.size() == file.size() && Stem(name) + ".txt" == name) others.push_back(name);
    }
    if (others.empty()) return candidate;
    throw Error(ErrorKind::kBadInput, {candidate},
                "has no " + file + " to take the " + what + " from; there are: " + Join(others));
  }
  throw Error(ErrorKind::kBadInput, std::string(what) + " '" + path + "' is neither in " + root +
                                        " nor in the current folder: check the path");
}

/// Paths "folder/SEQUENCE.txt" whose first row could be a pose (or else a detection), to choose
/// from. Ground truth is not offered.
std::vector<std::string> Candidates(const std::string& root, const std::string& sequence,
                                    bool poses) {
  std::vector<std::string> found;
  for (const std::string& folder : FileNames(root)) {
    const std::string kind = folder.substr(0, 4);
    const std::string file = folder + "/" + sequence + ".txt";
    if (kind == "cali" || kind == "labe" || kind == "oxts" || !IsFile(root + "/" + file)) continue;
    TextRows row(root + "/" + file);
    if (row.Next() && (row.size() == 8 || row.size() == 12) == poses) found.push_back(file);
  }
  return found;
}

DatasetLayout SequenceLayout(const std::string& folder) {
  DatasetLayout layout;
  layout.format = DatasetFormat::kSequence;
  layout.name = LastName(folder);
  layout.odometry = IfFile(folder + "/odometry.txt");
  layout.detections = IfFile(folder + "/detections.txt");
  if (layout.detections.empty()) layout.detections = IfFolder(folder + "/detections");
  layout.groundtruth = IfFile(folder + "/groundtruth.txt");
  layout.times = IfFile(folder + "/times.txt");
  layout.calib = IfFile(folder + "/calib.txt");
  layout.sequence_yaml = IfFile(folder + "/sequence.yaml");
  layout.embeddings = IfFile(folder + "/embeddings.npy");
  layout.colours = IfFile(folder + "/colours.npy");
  const auto complete =
      std::find_if(kImagePairs.begin(), kImagePairs.end(), [&](const ImagePair& pair) {
        return HasImages(folder + pair.left) && HasImages(folder + pair.right);
      });
  const ImagePair& pair = complete == kImagePairs.end() ? kImagePairs[0] : *complete;
  layout.images = IfFolder(folder + pair.left);
  layout.images_right = IfFolder(folder + pair.right);
  layout.cameras = pair.cameras;
  return layout;
}

DatasetLayout OdometryLayout(const std::string& root, const std::string& wanted) {
  std::set<std::string> available;
  for (const std::string& name : FileNames(root + "/sequences")) {
    if (IsFolder(root + "/sequences/" + name)) available.insert(name);
  }
  const std::string sequence = ChooseSequence(root, wanted, available);
  DatasetLayout layout = SequenceLayout(root + "/sequences/" + sequence);
  layout.format = DatasetFormat::kKittiOdometry;
  layout.groundtruth = IfFile(root + "/poses/" + sequence + ".txt");
  return layout;
}

DatasetLayout TrackingLayout(const std::string& root, const std::string& wanted) {
  std::set<std::string> available;
  for (const char* folder : {"calib", "label_02", "oxts", "image_02"}) {
    for (const std::string& name : FileNames(root + "/" + folder)) available.insert(Stem(name));
  }
  DatasetLayout layout;
  layout.format = DatasetFormat::kKittiTracking;
  layout.name = ChooseSequence(root, wanted, available);
  layout.groundtruth = IfFile(root + "/oxts/" + layout.name + ".txt");
  layout.calib = IfFile(root + "/calib/" + layout.name + ".txt");
  layout.images = IfFolder(root + "/image_02/" + layout.name);
  layout.images_right = IfFolder(root + "/image_03/" + layout.name);
  return layout;
}

DatasetLayout RawLayout(const std::string& root) {
  DatasetLayout layout;
  layout.format = DatasetFormat::kKittiRaw;
  layout.name = LastName(root);
  layout.odometry = IfFolder(root + "/oxts/data");
  layout.detections = IfFile(root + "/tracklet_labels.xml");
  layout.times = IfFile(root + "/oxts/timestamps.txt");
  layout.images = IfFolder(root + "/image_02/data");
  layout.images_right = IfFolder(root + "/image_03/data");
  layout.image_digits = 10;
  for (const std::string& folder : {root + "/..", root}) {
    if (IsFile(folder + "/calib_cam_to_cam.txt")) layout.calib = folder;
  }
  return layout;
}

[[noreturn]] void FailMissing(const std::string& root, const DatasetLayout& layout,
                              const char* what, bool poses, PartPolicy policy) {
  std::string message =
      std::string("no ") + what + " here for '" + layout.name + "': name a file (--" + what + ")";
  if (layout.format == DatasetFormat::kKittiTracking) {
    message += "; there are: " + Join(Candidates(root, layout.name, poses));
  } else if (layout.format == DatasetFormat::kKittiRaw) {
    message += poses ? " or add oxts/data" : " or add tracklet_labels.xml";
  } else {
    message += poses ? " or add odometry.txt" : " or add detections.txt";
  }
  if (policy == PartPolicy::kIfThere)
    message +=
        "; or add left and right images (image_2, image_3; grey: image_0, image_1) to make it from";
  throw Error(ErrorKind::kBadInput, {root}, message);
}

}  // namespace

DatasetLayout FindDatasetLayout(const DatasetRequest& request) {
  std::string root = request.path;
  if (!IsFolder(root))
    throw Error(ErrorKind::kBadInput, {root}, "no such folder: check the path of the dataset");
  // The folder may hold several sequence folders or drives side by side.
  const std::string inner = root + "/" + request.sequence;
  const bool is_inner =
      !request.sequence.empty() && (LooksLikeSequence(inner) || LooksLikeRaw(inner));
  if (is_inner) root = inner;

  const DatasetFormat format =
      request.format == DatasetFormat::kAuto ? Guess(root) : request.format;
  const bool by_name =
      format == DatasetFormat::kKittiOdometry || format == DatasetFormat::kKittiTracking;
  if (!by_name && !is_inner && !request.sequence.empty() && request.sequence != LastName(root)) {
    std::set<std::string> available;
    for (const std::string& name : FileNames(root)) {
      if (LooksLikeSequence(root + "/" + name) || LooksLikeRaw(root + "/" + name))
        available.insert(name);
    }
    ChooseSequence(root, request.sequence, available);  // throws
  }
  DatasetLayout layout;
  switch (format) {
    case DatasetFormat::kKittiOdometry: layout = OdometryLayout(root, request.sequence); break;
    case DatasetFormat::kKittiTracking: layout = TrackingLayout(root, request.sequence); break;
    case DatasetFormat::kKittiRaw: layout = RawLayout(root); break;
    default: layout = SequenceLayout(root); break;
  }
  const std::string sequence = by_name ? layout.name : request.sequence;
  const bool ignore_odometry = request.odometry_policy == PartPolicy::kIgnored;
  if (!request.odometry.empty() || ignore_odometry) {
    // A raw drive's GPS/IMU poses are its ground truth as soon as it has another odometry.
    if (format == DatasetFormat::kKittiRaw) layout.groundtruth = layout.odometry;
    layout.odometry = ignore_odometry ? "" : Resolve(root, request.odometry, sequence, "odometry");
  }
  if (request.detections_policy == PartPolicy::kIgnored)
    layout.detections = layout.embeddings = layout.colours = "";
  else if (!request.detections.empty())
    layout.detections = Resolve(root, request.detections, sequence, "detections");
  if (!request.groundtruth.empty())
    layout.groundtruth = Resolve(root, request.groundtruth, sequence, "groundtruth");
  const auto missing = [&layout](const std::string& path, PartPolicy policy) {
    const bool images = !layout.images.empty() && !layout.images_right.empty();
    return path.empty() && policy != PartPolicy::kIgnored &&
           !(policy == PartPolicy::kIfThere && images);
  };
  if (missing(layout.odometry, request.odometry_policy))
    FailMissing(root, layout, "odometry", true, request.odometry_policy);
  if (missing(layout.detections, request.detections_policy))
    FailMissing(root, layout, "detections", false, request.detections_policy);
  return layout;
}

}  // namespace sslcd
