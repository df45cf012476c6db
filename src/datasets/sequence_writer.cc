// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/sequence_writer.h"

#include <algorithm>
#include <utility>

#include "datasets/sequence_yaml.h"
#include "datasets/stamps.h"
#include "formats/calib.h"
#include "formats/file_set.h"
#include "formats/npy.h"
#include "sslcd/core/error.h"
#include "sslcd/formats/detections.h"
#include "sslcd/formats/poses.h"

namespace sslcd {
namespace {

using Detections = std::vector<std::vector<Detection>>;

std::string SequenceYaml(const SequenceFiles& files) {
  SequenceInfo info;
  info.up_axis = files.up_axis;
  if (files.camera) {
    info.image_width = files.camera->left.width;
    info.image_height = files.camera->left.height;
  }
  info.labels = files.labels;
  return (files.comment.empty() ? "" : "# " + files.comment + "\n") + SequenceYamlText(info);
}

/// One row per detection. Empty if no detection has the vector, or if `all` is set and one lacks
/// it.
std::string Npy(const Detections& detections, const CueRow& cue) {
  NpyMatrix matrix;
  bool gaps = false;
  for (const auto& frame : detections) {
    for (const Detection& detection : frame) {
      const std::vector<float>& row = detection.appearance[cue.cue];
      matrix.columns = std::max(matrix.columns, row.size());
      gaps = gaps || row.empty();
    }
  }
  if (matrix.columns == 0 || (cue.complete && gaps)) return "";
  for (const auto& frame : detections) {
    for (const Detection& detection : frame) {
      const std::vector<float>& row = detection.appearance[cue.cue];
      matrix.values.insert(matrix.values.end(), row.begin(), row.end());
      matrix.values.resize(++matrix.rows * matrix.columns, 0.f);
    }
  }
  return NpyBytes(matrix);
}

}  // namespace

void WriteSequenceFiles(const std::filesystem::path& folder, const SequenceFiles& files) {
  FileSet set;
  set.folder = folder.string();
  set.name = "sequence";
  const auto write = [&](const char* name, const std::string& text) {
    set.files.emplace_back((folder / name).string(), text);
  };
  const auto write_or_remove = [&](const char* name, const std::string& bytes) {
    if (bytes.empty())
      set.removed.push_back((folder / name).string());
    else
      write(name, bytes);
  };
  write_or_remove("calib.txt", files.camera ? CalibrationText(*files.camera) : "");
  write("times.txt", TimesText(files.odometry.stamps));
  write("odometry.txt", TumText(files.odometry));
  write_or_remove("groundtruth.txt", files.groundtruth ? TumText(*files.groundtruth) : "");
  write("detections.txt", DetectionsText(files.detections));
  write("sequence.yaml", SequenceYaml(files));
  for (const CueRow& cue : kCueRows) write_or_remove(cue.file, Npy(files.detections, cue));
  if (!files.config_yaml.empty()) write("config.yaml", files.config_yaml);
  WriteFileSet(std::move(set));
}

FileLock PrepareSequenceFolder(const std::filesystem::path& folder, bool overwrite,
                               const std::string& way_out) {
  FileLock lock = LockFolder(folder.string());
  if (!overwrite && !IsEmptyFolder(folder.string()))
    throw Error(ErrorKind::kUsage, folder.string() + ": is not empty; " + way_out);
  return lock;
}

}  // namespace sslcd
