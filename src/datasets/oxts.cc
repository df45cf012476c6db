// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/oxts.h"

#include <cmath>
#include <optional>

#include "formats/files.h"
#include "formats/text_rows.h"

namespace sslcd {
namespace {

constexpr std::size_t kPacketSize = 30;
constexpr double kEarthRadius = 6378137.;  // [m]
constexpr double kDegree = M_PI / 180.;

/// One packet as T_mercator_imu. `scale` = cos(latitude of the first packet) makes the projection
/// metric there.
Pose PoseOfPacket(const TextRows& row, std::optional<double>& scale) {
  if (row.size() != kPacketSize) {
    row.Fail("found " + std::to_string(row.size()) + " columns, expected 30 (an oxts packet)");
  }
  double v[6];
  for (int i = 0; i < 6; ++i) {
    v[i] = row.Number(i);
    if (!std::isfinite(v[i])) row.Fail("a value of the oxts packet is not finite");
  }
  if (!(std::abs(v[0]) < 90))
    row.Fail("latitude " + std::string(row.Text(0)) + " lies outside (-90, 90) degrees");
  if (!scale) scale = std::cos(v[0] * kDegree);
  const Vec3 t(*scale * kEarthRadius * v[1] * kDegree,
               *scale * kEarthRadius * std::log(std::tan((90 + v[0]) * kDegree / 2)), v[2]);
  const auto R =
      lie::SO3<double>::RotZ(v[5]) * lie::SO3<double>::RotY(v[4]) * lie::SO3<double>::RotX(v[3]);
  return Pose(R, t);
}

/// Days since 1970-01-01 of a Gregorian date (H. Hinnant's days_from_civil).
long DaysFromCivil(long year, long month, long day) {
  if (month <= 2) --year;
  const long era = (year >= 0 ? year : year - 399) / 400;
  const long year_of_era = year - era * 400;
  const long day_of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
}

}  // namespace

std::vector<Pose> ReadOxts(const std::string& path) {
  std::vector<Pose> poses;
  std::optional<double> scale;
  const auto read_rows = [&](const std::string& file) {
    TextRows row(file);
    while (row.Next()) poses.push_back(PoseOfPacket(row, scale));
  };
  if (!IsFolder(path)) {
    read_rows(path);
  } else {
    for (const NumberedFile& file : NumberedFiles(path, ".txt")) {
      if (file.number != static_cast<int>(poses.size())) {
        throw Error(ErrorKind::kBadInput, {path},
                    "oxts packet " + std::to_string(poses.size()) + " is missing");
      }
      read_rows(file.path);
      if (poses.size() != static_cast<std::size_t>(file.number) + 1) {
        throw Error(ErrorKind::kBadInput, {file.path}, "expected exactly one oxts packet");
      }
    }
  }
  if (poses.empty()) return poses;
  const Pose T_first_mercator = poses.front().inverse();
  for (Pose& pose : poses) pose = T_first_mercator * pose;
  return poses;
}

std::vector<Pose> ReadOxtsCamera(const std::string& path, const Calibration& calibration) {
  if (!calibration.HasImu()) {
    throw Error(ErrorKind::kBadInput, {path},
                "the calibration lacks the transform from IMU to camera: add Tr_velo_to_cam and "
                "Tr_imu_to_velo to calib.txt, or "
                "calib_velo_to_cam.txt and calib_imu_to_velo.txt to a raw drive");
  }
  const Pose T_cam_imu = *calibration.T_cam_velo * *calibration.T_velo_imu;
  std::vector<Pose> poses = ReadOxts(path);
  for (Pose& pose : poses) pose = T_cam_imu * pose * T_cam_imu.inverse();
  return poses;
}

std::vector<double> ReadTimestamps(const std::string& path) {
  std::vector<double> stamps;
  long first_day = 0;
  double first_second = 0;
  TextRows row(path);
  while (row.Next()) {
    const auto part = [&row](std::size_t field, std::size_t begin, std::size_t length, double least,
                             double end) {
      const std::string_view text = row.Text(field);
      const auto value =
          begin < text.size() ? ParseNumber(text.substr(begin, length)) : std::nullopt;
      if (!value || !(*value >= least && *value < end))
        row.Fail("expected a stamp like '2011-09-26 13:02:25.964389445'");
      return *value;
    };
    if (row.size() != 2) row.Fail("expected date and time, like '2011-09-26 13:02:25.964389445'");
    const long day =
        DaysFromCivil(std::lround(part(0, 0, 4, 1, 10000)), std::lround(part(0, 5, 2, 1, 13)),
                      std::lround(part(0, 8, 2, 1, 32)));
    const double second = part(1, 0, 2, 0, 24) * 3600 + part(1, 3, 2, 0, 60) * 60 +
                          part(1, 6, std::string_view::npos, 0, 61);  // a leap second
    if (stamps.empty()) {
      first_day = day;
      first_second = second;
    }
    const double stamp = static_cast<double>(day - first_day) * 86400. + (second - first_second);
    if (!stamps.empty() && !(stamp > stamps.back()))
      row.Fail("the stamp does not come after the one before");
    stamps.push_back(stamp);
  }
  return stamps;
}

}  // namespace sslcd
