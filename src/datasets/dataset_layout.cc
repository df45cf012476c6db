// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/dataset_layout.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "datasets/image_folder.h"
#include "formats/files.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

/// Whether the folder itself is a sequence of a known format.
bool IsSequence(const std::string& folder) {
  const auto& readers = DatasetReaders();
  return std::any_of(readers.begin(), readers.end(), [&](const DatasetReader& reader) {
    return reader.sequences == nullptr && reader.looks_like(folder);
  });
}

std::string Stem(const std::string& name) { return name.substr(0, name.find('.')); }

/// The subfolders that are sequences.
std::set<std::string> SequencesInside(const std::string& root) {
  std::set<std::string> names;
  for (const std::string& name : FileNames(root)) {
    if (IsSequence(fs::path(root) / name)) names.insert(name);
  }
  return names;
}

/// What to do with images in a folder of no known format.
std::string AdviceForImages(const std::string& root) {
  const auto has_images = [](const fs::path& folder) {
    const std::vector<std::string> names = FileNames(folder);
    return std::any_of(names.begin(), names.end(), IsImageName);
  };
  const std::string wanted =
      "the rectified images of the left camera belong into left/, those of the right one into "
      "right/, beside calib.txt";
  if (has_images(root)) return ". It holds images itself: " + wanted;
  std::vector<std::string> folders;
  for (const std::string& name : FileNames(root))
    if (has_images(fs::path(root) / name)) folders.push_back(name + "/");
  return folders.empty() ? "" : ". It holds images in " + Join(folders) + ": " + wanted;
}

[[noreturn]] void FailUnknown(const std::string& root) {
  std::vector<std::string> known;
  for (const DatasetReader& reader : DatasetReaders())
    known.push_back(std::string(reader.name) + " (" + reader.description + ")");
  std::string message = "not a dataset folder of a known format; known are " + Join(known);
  const std::set<std::string> inside = SequencesInside(root);
  if (inside.empty()) message += AdviceForImages(root);
  if (!inside.empty())
    message += ". There are sequences inside, name one: " + Join({inside.begin(), inside.end()});
  throw Error(ErrorKind::kBadInput, {root}, message);
}

const DatasetReader& ReaderOf(const std::string& root, const std::string& format) {
  for (const DatasetReader& reader : DatasetReaders()) {
    if (format == "auto" ? reader.looks_like(root) : format == reader.name) return reader;
  }
  if (format == "auto") FailUnknown(root);
  throw Error(ErrorKind::kUsage,
              "no dataset format '" + format + "'; there are: " + Join(DatasetFormatNames()));
}

/// Checks that `wanted` is available; an empty name stands for the only sequence.
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

/// Resolves a path of the request, relative to the dataset or to the current folder. In a folder it
/// finds the file of the sequence.
std::string Resolve(const std::string& root, const std::string& path, const std::string& sequence,
                    const char* what) {
  for (const std::string& candidate : {(fs::path(root) / path).string(), path}) {
    if (IsFile(candidate)) return candidate;
    if (!IsFolder(candidate)) continue;
    const std::string file = sequence + ".txt";
    if (sequence.empty()) return candidate;
    if (const std::string found = IfFile(fs::path(candidate) / file); !found.empty()) return found;
    // Files of other sequences; files of frames (000000.txt) have longer names.
    std::vector<std::string> others;
    for (const std::string& name : FileNames(candidate)) {
      if (name.size() == file.size() && Stem(name) + ".txt" == name) others.push_back(name);
    }
    if (others.empty()) return candidate;
    throw Error(ErrorKind::kBadInput, {candidate},
                "has no " + file + " for the " + what + "; there are: " + Join(others));
  }
  throw Error(ErrorKind::kBadInput, std::string(what) + " '" + path + "' is neither in " + root +
                                        " nor in the current folder: check the path");
}

/// Paths "folder/SEQUENCE.txt" to suggest: their first row could be a pose (or a detection). Ground
/// truth is not suggested.
std::vector<std::string> Candidates(const fs::path& root, const std::string& sequence, bool poses) {
  std::vector<std::string> found;
  for (const std::string& folder : FileNames(root)) {
    const std::string kind = folder.substr(0, 4);
    const fs::path file = fs::path(folder) / (sequence + ".txt");
    if (kind == "cali" || kind == "labe" || kind == "oxts" || !IsFile(root / file)) continue;
    TextRows row(root / file);
    if (row.Next() && (row.size() == 8 || row.size() == 12) == poses) found.push_back(file);
  }
  return found;
}

[[noreturn]] void FailMissing(const std::string& root, const DatasetLayout& layout,
                              const char* what, bool poses, PartPolicy policy) {
  std::string message =
      std::string("no ") + what + " here for '" + layout.name + "': name a file (--" + what + ")";
  const std::string& file = poses ? layout.odometry_file : layout.detections_file;
  message += file.empty() ? "; there are: " + Join(Candidates(root, layout.name, poses))
                          : " or add " + file;
  if (policy == PartPolicy::kIfThere && !layout.images.empty())
    message +=
        ". It cannot be made from " + layout.images +
        ": one camera shows no distances. Add the images of the right camera (right, image_3, "
        "image_1); with one camera bring odometry in metres and 3D detections";
  else if (policy == PartPolicy::kIfThere)
    message +=
        "; or add left and right images to make it from (left, right; image_2, image_3; grey: "
        "image_0, image_1)";
  throw Error(ErrorKind::kBadInput, {root}, message);
}

}  // namespace

DatasetLayout FindDatasetLayout(const DatasetRequest& request) {
  std::string root = request.path;
  if (!IsFolder(root))
    throw Error(ErrorKind::kBadInput, {root}, "no such folder: check the path of the dataset");
  // The folder may contain several sequence folders or drives.
  const std::string inner = fs::path(root) / request.sequence;
  const bool is_inner = !request.sequence.empty() && IsSequence(inner);
  if (is_inner) root = inner;

  const DatasetReader& reader = ReaderOf(root, request.format);
  const bool by_name = reader.sequences != nullptr;
  if (!by_name && !is_inner && !request.sequence.empty() && request.sequence != LastName(root))
    ChooseSequence(root, request.sequence, SequencesInside(root));  // throws
  const std::string sequence =
      by_name ? ChooseSequence(root, request.sequence, reader.sequences(root)) : request.sequence;
  DatasetLayout layout = reader.find(root, sequence);
  layout.format = reader.name;
  const bool ignore_odometry = request.odometry_policy == PartPolicy::kIgnored;
  if (!request.odometry.empty() || ignore_odometry) {
    if (layout.odometry_is_truth) layout.groundtruth = layout.odometry;
    layout.odometry_is_truth = false;
    layout.odometry = ignore_odometry ? "" : Resolve(root, request.odometry, sequence, "odometry");
  }
  if (request.detections_policy == PartPolicy::kIgnored) {
    layout.detections = "";
    layout.appearance = {};
  } else if (!request.detections.empty()) {
    layout.detections = Resolve(root, request.detections, sequence, "detections");
  }
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

std::vector<std::pair<std::string, std::string>> PartsOf(const DatasetLayout& layout) {
  std::vector<std::pair<std::string, std::string>> parts = {
      {"odometry", layout.odometry},
      {"detections", layout.detections},
      {"ground truth", layout.groundtruth},
      {"annotated boxes", layout.groundtruth_boxes},
      {"stamps", layout.times},
      {"calibration", layout.calib},
      {"description", layout.sequence_yaml}};
  for (const CueRow& row : kCueRows) parts.emplace_back(row.name, layout.appearance[row.cue]);
  parts.emplace_back("left images", layout.images);
  parts.emplace_back("right images", layout.images_right);
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                             [](const auto& part) { return part.second.empty(); }),
              parts.end());
  return parts;
}

}  // namespace sslcd
