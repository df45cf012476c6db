// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/eval/kitti_ground_truth.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Words = std::vector<std::string>;

/// Calls `take` with the words of each line that has any.
void ForEachRow(const std::string& path, const std::function<void(const Words&, const FileLocation&)>& take) {
  std::ifstream file(path);
  if (!file) throw Error(ErrorKind::kBadInput, {path}, "cannot be opened: check that it exists and may be read");
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream stream(line);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (!words.empty()) take(words, {path, number});
  }
  if (file.bad()) throw Error(ErrorKind::kBadInput, {path}, "cannot be read: is it a file?");
}

template <class Number>
Number Parse(const std::string& word, const FileLocation& where, const char* what) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw Error(ErrorKind::kBadInput, where, std::string("expected ") + what + ", got '" + word + "'");
  }
  return value;
}

/// KITTI: x right, y down, z forward; rotation_y about +y, zero along x; the location is on the ground.
Pose PoseOfLabel(const Vec3& bottom_centre, double height, double rotation_y) {
  return Pose(GravityFrame().Upright(-rotation_y), bottom_centre - Vec3(0, 0.5 * height, 0));
}

}  // namespace

std::vector<GroundTruthBox> ReadKittiTrackingLabels(const std::string& path) {
  std::vector<GroundTruthBox> boxes;
  ForEachRow(path, [&](const Words& words, const FileLocation& where) {
    if (words.size() != 17 && words.size() != 18) {
      throw Error(ErrorKind::kBadInput, where,
                  "a row of " + std::to_string(words.size()) +
                      " columns: KITTI tracking labels have 17 (frame, track, label, ... , rotation_y)");
    }
    GroundTruthBox box;
    box.frame = Parse<int>(words[0], where, "a frame number");
    box.track = Parse<int>(words[1], where, "a track id");
    box.label = words[2];
    if (box.frame < 0) throw Error(ErrorKind::kBadInput, where, "the frame number is negative: frames count from 0");
    double v[7];  // h w l x y z rotation_y
    for (int k = 0; k < 7; ++k) v[k] = Parse<double>(words[10 + k], where, "a number");
    if (box.label == "DontCare") return;
    for (const double value : v) {
      if (!std::isfinite(value)) throw Error(ErrorKind::kBadInput, where, "the box is not finite: remove the row");
    }
    box.dims = {v[2], v[1], v[0]};
    box.T_cam_object = PoseOfLabel({v[3], v[4], v[5]}, v[0], v[6]);
    boxes.push_back(box);
  });
  return boxes;
}

std::vector<int> ReadLandmarkIds(const std::string& path) {
  std::vector<int> ids;
  ForEachRow(path, [&](const Words& words, const FileLocation& where) {
    if (words.size() != 1) {
      throw Error(ErrorKind::kBadInput, where, "expected one identity a line, got " + std::to_string(words.size()));
    }
    ids.push_back(Parse<int>(words[0], where, "an integer identity"));
  });
  return ids;
}

}  // namespace sslcd
