// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/io/sequence_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sslcd/core/error.h"
#include "sslcd/core/upright.h"
#include "sslcd/io/atomic_file.h"
#include "sslcd/io/npy.h"
#include "sslcd/io/run_folder.h"

namespace sslcd {
namespace {

using Detections = std::vector<std::vector<Detection>>;

template <class... Numbers>
std::string Format(const char* format, Numbers... numbers) {
  char text[512];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// Row "Pn: ..." of K [I | t].
std::string CalibRow(int number, const Camera& camera) {
  const Vec3& offset = camera.offset;
  const Vec3 column(camera.fx * offset.x() + camera.cx * offset.z(),
                    camera.fy * offset.y() + camera.cy * offset.z(), offset.z());
  return Format("P%d: %.12g 0 %.12g %.12g 0 %.12g %.12g %.12g 0 0 1 %.12g\n", number, camera.fx,
                camera.cx, column.x(), camera.fy, camera.cy, column.y(), column.z());
}

std::string Calib(const StereoCamera& stereo) {
  StereoCamera at_reference = stereo;
  at_reference.left.offset.setZero();
  return CalibRow(0, at_reference.left) + CalibRow(1, RightOf(at_reference)) +
         CalibRow(2, stereo.left) + CalibRow(3, RightOf(stereo));
}

std::string Times(const std::vector<double>& stamps) {
  std::string text;
  for (double stamp : stamps) text += Format("%.6f\n", stamp);
  return text;
}

/// KITTI tracking: frame track label truncated occluded alpha, box, h w l, centre of the bottom
/// face, rotation_y, score.
std::string DetectionRow(int frame, const Detection& detection) {
  const Box2d box = detection.box.value_or(Box2d{-1, -1, -1, -1});
  const Vec3& centre = detection.T_cam_object.translation();
  // rotation_y turns about +y, which points down; yaw counts about up.
  const double rotation_y = WrapAngle(-GravityFrame().YawOf(detection.T_cam_object.so3()));
  const double alpha = WrapAngle(rotation_y - std::atan2(centre.x(), centre.z()));
  const Vec3& d = detection.dims;
  return Format("%d -1 %s -1 -1 %.4f %.2f %.2f %.2f %.2f %.4f %.4f %.4f %.4f %.4f %.4f %.5f %.3f\n",
                frame, detection.label.c_str(), alpha, box.left, box.top, box.right, box.bottom,
                d.z(), d.y(), d.x(), centre.x(), centre.y() + 0.5 * d.z(), centre.z(), rotation_y,
                detection.score);
}

std::string Rows(const Detections& detections) {
  std::string text;
  for (std::size_t frame = 0; frame < detections.size(); ++frame)
    for (const Detection& detection : detections[frame])
      text += DetectionRow(static_cast<int>(frame), detection);
  return text;
}

std::string SequenceYaml(const SequenceFiles& files) {
  std::string text = files.comment.empty() ? "" : "# " + files.comment + "\n";
  text += Format("up_axis: [%.9g, %.9g, %.9g]\n", files.up_axis.x(), files.up_axis.y(),
                 files.up_axis.z());
  if (files.camera && files.camera->left.width > 0)
    text +=
        Format("image_size_px: [%d, %d]\n", files.camera->left.width, files.camera->left.height);
  if (!files.labels.entries().empty()) text += "labels:\n";
  for (const auto& [label, info] : files.labels.entries())
    text += "  " + label + ": {symmetry: " + ToString(info.symmetry) + "}\n";
  return text;
}

/// One row a detection; empty where none has such a vector, or where all should have one and some
/// have not.
std::string Npy(const Detections& detections, std::vector<float> Detection::*vector, bool all) {
  NpyMatrix matrix;
  bool gaps = false;
  for (const auto& frame : detections) {
    for (const Detection& detection : frame) {
      matrix.columns = std::max(matrix.columns, (detection.*vector).size());
      gaps = gaps || (detection.*vector).empty();
    }
  }
  if (matrix.columns == 0 || (all && gaps)) return "";
  for (const auto& frame : detections) {
    for (const Detection& detection : frame) {
      const std::vector<float>& row = detection.*vector;
      matrix.values.insert(matrix.values.end(), row.begin(), row.end());
      matrix.values.resize(++matrix.rows * matrix.columns, 0.f);
    }
  }
  return NpyBytes(matrix);
}

}  // namespace

void WriteSequenceFiles(const std::filesystem::path& folder, const SequenceFiles& files) {
  std::vector<std::pair<std::string, std::string>> written;
  std::vector<std::filesystem::path> removed;  // what is left from before would be of other frames
  const auto write = [&](const char* name, const std::string& text) {
    written.emplace_back((folder / name).string(), text);
  };
  const auto write_or_remove = [&](const char* name, const std::string& bytes) {
    if (bytes.empty())
      removed.push_back(folder / name);
    else
      write(name, bytes);
  };
  write_or_remove("calib.txt", files.camera ? Calib(*files.camera) : "");
  write("times.txt", Times(files.odometry.stamps));
  write("odometry.txt", TumText(files.odometry));
  write_or_remove("groundtruth.txt", files.groundtruth ? TumText(*files.groundtruth) : "");
  write("detections.txt", Rows(files.detections));
  write("sequence.yaml", SequenceYaml(files));
  write_or_remove("embeddings.npy", Npy(files.detections, &Detection::embedding, false));
  write_or_remove("colours.npy", Npy(files.detections, &Detection::colour, true));
  if (!files.config_yaml.empty()) write("config.yaml", files.config_yaml);
  WriteFilesAtomically(written);
  for (const std::filesystem::path& path : removed) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error)
      throw Error(ErrorKind::kOutput, path.string() + ": cannot be removed: " + error.message());
  }
}

void PrepareSequenceFolder(const std::filesystem::path& folder, bool overwrite) {
  MakeWritableFolder(folder.string());
  std::error_code error;
  const bool empty = std::filesystem::is_empty(folder, error);
  if (error)
    throw Error(ErrorKind::kOutput,
                folder.string() + ": " + error.message() + "; choose another folder");
  if (!overwrite && !empty)
    throw Error(
        ErrorKind::kUsage,
        folder.string() + ": is not empty; choose another folder or overwrite it (--force)");
}

}  // namespace sslcd
