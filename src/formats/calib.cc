// SPDX-License-Identifier: BSD-3-Clause
#include "formats/calib.h"

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "formats/files.h"
#include "formats/number_text.h"
#include "formats/text_rows.h"

namespace sslcd {
namespace {

constexpr double kMostPixels = 1e5;  // of a side of an image

struct Entry {
  int line = 0;
  std::vector<std::string> fields;
};

/// Rows "key: field field ..." by key. Rows without keys are P0, P1, ... Fields become numbers only
/// on use, since some are dates.
class Entries {
 public:
  explicit Entries(const std::string& path) : path_(path) {
    TextRows row(path);
    std::map<std::string, Entry> nameless;
    while (row.Next()) {
      std::string key(row.Text(0));
      const bool named = !ParseNumber(key);
      if (!key.empty() && key.back() == ':') key.pop_back();
      if (key.empty())
        throw Error(ErrorKind::kBadInput, row.where(), "a row 'key: numbers' without a key");
      Entry& entry = named ? entries_[key] : nameless["P" + std::to_string(nameless.size())];
      entry.line = row.where().line;
      entry.fields.clear();
      for (std::size_t i = named ? 1 : 0; i < row.size(); ++i)
        entry.fields.emplace_back(row.Text(i));
      last_line_ = entry.line;
    }
    if (entries_.empty()) entries_ = std::move(nameless);
  }

  /// The first existing key as `count` numbers; empty: the file has none of the keys.
  std::vector<double> Numbers(const std::vector<const char*>& keys, std::size_t count) {
    for (const char* key : keys) {
      const auto it = entries_.find(key);
      if (it == entries_.end()) continue;
      used_line_ = it->second.line;
      std::vector<double> numbers;
      for (const std::string& field : it->second.fields) {
        const std::optional<double> number = ParseNumber(field);
        if (!number) Fail(std::string(key) + ": expected a number, found '" + field + "'");
        numbers.push_back(*number);
      }
      if (numbers.size() != count) {
        Fail(std::string(key) + ": found " + std::to_string(numbers.size()) +
             " numbers, expected " + std::to_string(count));
      }
      return numbers;
    }
    return {};
  }

  std::optional<Camera> CameraOf(const std::vector<const char*>& keys) {
    const std::vector<double> P = Numbers(keys, 12);
    if (P.empty()) return std::nullopt;
    Camera camera;
    camera.fx = P[0];
    camera.cx = P[2];
    camera.fy = P[5];
    camera.cy = P[6];
    const double depth = P[11];
    camera.offset =
        Vec3((P[3] - camera.cx * depth) / camera.fx, (P[7] - camera.cy * depth) / camera.fy, depth);
    if (!(camera.fx > 0 && camera.fy > 0) || !camera.offset.allFinite()) {
      Fail(std::string(keys[0]) +
           " is no projection matrix: its focal lengths must be positive, all numbers finite");
    }
    return camera;
  }

  std::optional<Pose> Rigid(const std::vector<const char*>& keys) {
    const std::vector<double> M = Numbers(keys, 12);
    if (M.empty()) return std::nullopt;
    return MakeRigid({M[0], M[1], M[2], M[4], M[5], M[6], M[8], M[9], M[10]}, {M[3], M[7], M[11]});
  }

  std::optional<Pose> Rotation(const std::vector<const char*>& keys) {
    const std::vector<double> M = Numbers(keys, 9);
    if (M.empty()) return std::nullopt;
    return MakeRigid(M, {0, 0, 0});
  }

  Pose MakeRigid(const std::vector<double>& R, const std::vector<double>& t) const {
    const auto pose =
        RigidFromMatrix(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data()),
                        Vec3(t[0], t[1], t[2]));
    if (!pose) Fail("not a rotation matrix: correct the entry");
    return *pose;
  }

  /// Fails at the entry used last, or at the end of the file.
  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(ErrorKind::kBadInput,
                {path_, used_line_ > 0 ? used_line_ : std::max(last_line_, 1)}, message);
  }

  std::string Keys() const {
    std::vector<std::string> keys;
    for (const auto& [key, entry] : entries_) keys.push_back(key);
    return Join(keys);
  }

 private:
  std::string path_;
  std::map<std::string, Entry> entries_;
  int last_line_ = 0;
  int used_line_ = 0;
};

/// "R: 9 numbers" and "T: 3 numbers", as in calib_velo_to_cam.txt.
std::optional<Pose> ReadRT(const std::string& path) {
  if (!IsFile(path)) return std::nullopt;
  Entries entries(path);
  const std::vector<double> R = entries.Numbers({"R"}, 9), T = entries.Numbers({"T"}, 3);
  if (R.empty() || T.empty()) entries.Fail("no R and T here, found: " + entries.Keys());
  return entries.MakeRigid(R, T);
}

/// Row "Pn: ..." of K [I | t].
std::string CalibRow(int number, const Camera& camera) {
  const Vec3& offset = camera.offset;
  const Vec3 column(camera.fx * offset.x() + camera.cx * offset.z(),
                    camera.fy * offset.y() + camera.cy * offset.z(), offset.z());
  std::string row = "P" + std::to_string(number) + ":";
  for (const double value : {camera.fx, 0., camera.cx, column.x(), 0., camera.fy, camera.cy,
                             column.y(), 0., 0., 1., column.z()})
    row += " " + RoundedNumber(value, 12);
  return row + "\n";
}

}  // namespace

Calibration ReadCalibration(const std::string& path, CameraPair pair) {
  Entries entries(path);
  Calibration calibration;
  const bool grey = pair == CameraPair::kGrey;
  calibration.left =
      grey ? entries.CameraOf({"P0", "P_rect_00", "P2"}) : entries.CameraOf({"P2", "P_rect_02"});
  if (!calibration.left) {
    entries.Fail((grey ? std::string("no P0 (or P2) here, the left camera")
                       : std::string("no P2 (or P_rect_02) here, the left colour camera")) +
                 "; found: " + entries.Keys() +
                 ". Add it (grey images are used only if both folders exist), or remove the "
                 "file if nothing is projected");
  }
  calibration.right =
      grey ? entries.CameraOf({"P1", "P_rect_01", "P3"}) : entries.CameraOf({"P3", "P_rect_03"});
  const char* size_key = grey ? "S_rect_00" : "S_rect_02";
  const std::vector<double> size = entries.Numbers({size_key}, 2);
  for (const double pixels : size)
    if (!(pixels >= 1 && pixels <= kMostPixels))
      entries.Fail(std::string(size_key) +
                   ": expected the width and the height of the images in pixels");
  for (std::optional<Camera>* camera : {&calibration.left, &calibration.right}) {
    if (!*camera || size.empty()) continue;
    (*camera)->width = static_cast<int>(size[0]);
    (*camera)->height = static_cast<int>(size[1]);
  }
  calibration.T_cam_velo = entries.Rigid({"Tr"});  // KITTI odometry: includes the rectification
  if (!calibration.T_cam_velo) {
    calibration.T_cam_velo = entries.Rigid({"Tr_velo_to_cam", "Tr_velo_cam"});
    const std::optional<Pose> rectification = entries.Rotation({"R0_rect", "R_rect"});
    if (calibration.T_cam_velo && rectification)
      calibration.T_cam_velo = *rectification * *calibration.T_cam_velo;
  }
  calibration.T_velo_imu = entries.Rigid({"Tr_imu_to_velo", "Tr_imu_velo"});
  return calibration;
}

Calibration ReadRawCalibration(const std::string& folder, CameraPair pair) {
  const std::string cam_to_cam = std::filesystem::path(folder) / "calib_cam_to_cam.txt";
  Calibration calibration = ReadCalibration(cam_to_cam, pair);
  calibration.T_cam_velo = ReadRT(std::filesystem::path(folder) / "calib_velo_to_cam.txt");
  const std::optional<Pose> rectification = Entries(cam_to_cam).Rotation({"R_rect_00"});
  if (calibration.T_cam_velo && rectification)
    calibration.T_cam_velo = *rectification * *calibration.T_cam_velo;
  calibration.T_velo_imu = ReadRT(std::filesystem::path(folder) / "calib_imu_to_velo.txt");
  return calibration;
}

std::string CalibrationText(const StereoCamera& stereo) {
  StereoCamera at_reference = stereo;
  at_reference.left.offset.setZero();
  return CalibRow(0, at_reference.left) + CalibRow(1, RightOf(at_reference)) +
         CalibRow(2, stereo.left) + CalibRow(3, RightOf(stereo));
}

}  // namespace sslcd
