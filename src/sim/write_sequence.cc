// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/sim/write_sequence.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "sslcd/core/error.h"
#include "sslcd/io/atomic_file.h"
#include "sslcd/io/npy.h"

namespace sslcd::sim {
namespace {

template <class... Numbers>
std::string Format(const char* format, Numbers... numbers) {
  char text[512];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// Row "Pn: ..." of K [I | t].
std::string CalibRow(int number, const Camera& camera, const Vec3& offset) {
  const Vec3 column(camera.fx * offset.x() + camera.cx * offset.z(), camera.fy * offset.y() + camera.cy * offset.z(),
                    offset.z());
  return Format("P%d: %.12g 0 %.12g %.12g 0 %.12g %.12g %.12g 0 0 1 %.12g\n", number, camera.fx, camera.cx, column.x(),
                camera.fy, camera.cy, column.y(), column.z());
}

std::string Calib(const Camera& camera, double baseline_m) {
  const Vec3 baseline(-baseline_m, 0, 0);
  return CalibRow(0, camera, Vec3::Zero()) + CalibRow(1, camera, baseline) + CalibRow(2, camera, camera.offset) +
         CalibRow(3, camera, camera.offset + baseline);
}

std::string Times(const Trajectory& trajectory) {
  std::string text;
  for (double stamp : trajectory.stamps) text += Format("%.6f\n", stamp);
  return text;
}

std::string Tum(const Trajectory& trajectory) {
  std::string text;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const auto& q = trajectory.poses[i].unit_quaternion();
    const Vec3& t = trajectory.poses[i].translation();
    text += Format("%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", trajectory.stamps[i], t.x(), t.y(), t.z(), q.x(), q.y(),
                   q.z(), q.w());
  }
  return text;
}

/// KITTI tracking: frame track label truncated occluded alpha, box, h w l, centre of the bottom face, rotation_y,
/// score.
std::string DetectionRow(int frame, const Detection& detection) {
  const Box2d box = detection.box.value_or(Box2d{-1, -1, -1, -1});
  const Vec3& centre = detection.T_cam_object.translation();
  // rotation_y turns about +y, which points down; yaw counts about up.
  const double rotation_y = WrapAngle(-GravityFrame().YawOf(detection.T_cam_object.so3()));
  const double alpha = WrapAngle(rotation_y - std::atan2(centre.x(), centre.z()));
  const Vec3& d = detection.dims;
  return Format("%d -1 %s -1 -1 %.4f %.2f %.2f %.2f %.2f %.4f %.4f %.4f %.4f %.4f %.4f %.5f %.3f\n", frame,
                detection.label.c_str(), alpha, box.left, box.top, box.right, box.bottom, d.z(), d.y(), d.x(),
                centre.x(), centre.y() + 0.5 * d.z(), centre.z(), rotation_y, detection.score);
}

std::string Detections(const SimulatedDetections& detections) {
  std::string text;
  for (std::size_t frame = 0; frame < detections.frames.size(); ++frame) {
    for (const Detection& detection : detections.frames[frame])
      text += DetectionRow(static_cast<int>(frame), detection);
  }
  return text;
}

std::string Identities(const SimulatedDetections& detections) {
  std::string text;
  for (int id : detections.identity) text += std::to_string(id) + "\n";
  return text;
}

std::string SequenceYaml(const World& world) {
  std::string text =
      Format("# a synthetic world; axes of the first camera: x right, y down, z forward\nup_axis: [%g, %g, %g]\n",
             world.gravity.up.x(), world.gravity.up.y(), world.gravity.up.z());
  text += "labels:\n";
  for (const auto& [label, info] : world.labels.entries()) {
    text += "  " + label + ": {symmetry: " + ToString(info.symmetry) + "}\n";
  }
  return text;
}

/// One row a detection; empty where the first one has no such vector.
std::string Npy(const SimulatedDetections& detections, std::vector<float> Detection::*vector) {
  NpyMatrix matrix;
  for (const std::vector<Detection>& frame : detections.frames) {
    for (const Detection& detection : frame) {
      const std::vector<float>& row = detection.*vector;
      if (row.empty()) return "";
      matrix.columns = row.size();
      ++matrix.rows;
      matrix.values.insert(matrix.values.end(), row.begin(), row.end());
    }
  }
  return matrix.rows > 0 ? NpyBytes(matrix) : "";
}

void PrepareFolder(const std::filesystem::path& folder, bool overwrite) {
  MakeWritableFolder(folder.string());
  if (!overwrite && !std::filesystem::is_empty(folder)) {
    throw Error(ErrorKind::kUsage, folder.string() + ": is not empty; choose another folder or overwrite it (--force)");
  }
}

}  // namespace

void WriteSequence(const World& world, const Trajectory& odometry, const SimulatedDetections& detections,
                   const std::filesystem::path& folder, bool overwrite) {
  PrepareFolder(folder, overwrite);
  const auto write = [&folder](const char* name, const std::string& text) {
    WriteFileAtomically((folder / name).string(), text);
  };
  write("calib.txt", Calib(world.camera, world.baseline_m));
  write("times.txt", Times(world.truth));
  write("odometry.txt", Tum(odometry));
  write("groundtruth.txt", Tum(world.truth));
  write("detections.txt", Detections(detections));
  write("landmark_ids.txt", Identities(detections));
  write("sequence.yaml", SequenceYaml(world));
  const auto write_or_remove = [&](const char* name, const std::string& npy) {
    npy.empty() ? void(std::filesystem::remove(folder / name)) : write(name, npy);  // one left there is another world's
  };
  write_or_remove("embeddings.npy", Npy(detections, &Detection::embedding));
  write_or_remove("colours.npy", Npy(detections, &Detection::colour));
}

}  // namespace sslcd::sim
