// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/formats/detections.h"

#include <array>
#include <cmath>
#include <optional>

#include "core/sigmoid.h"
#include "formats/files.h"
#include "formats/number_text.h"
#include "formats/text_rows.h"
#include "sslcd/core/pose.h"

namespace sslcd {
namespace {

/// The columns of a row format; -1: it has no such column.
struct Columns {
  int frame, label, alpha, box, dims, location, yaw, score;
};

Columns ColumnsOf(DetectionFormat format, std::size_t row_size) {
  switch (format) {
    case DetectionFormat::kAb3dmotCsv: return {0, 1, 14, 2, 7, 10, 13, 6};
    case DetectionFormat::kKittiTracking: return {0, 2, 5, 6, 10, 13, 16, row_size == 18 ? 17 : -1};
    default: return {-1, 0, 3, 4, 8, 11, 14, row_size == 16 ? 15 : -1};
  }
}

DetectionFormat Guess(const TextRows& row) {
  if (row.has_commas()) {
    if (row.size() == 15) return DetectionFormat::kAb3dmotCsv;
  } else {
    if (row.size() == 15 || row.size() == 16) return DetectionFormat::kKittiObject;
    if (row.size() == 17 || row.size() == 18) return DetectionFormat::kKittiTracking;
  }
  row.Fail("not a detection row: found " + std::to_string(row.size()) +
           (row.has_commas() ? " columns with commas, expected 15 (AB3DMOT csv)"
                             : " columns, expected 15 or 16 (KITTI object), 17 or 18 (KITTI "
                               "tracking) or an AB3DMOT csv"));
}

std::string LabelOf(const TextRows& row, DetectionFormat format, int column) {
  if (format == DetectionFormat::kAb3dmotCsv) {
    static constexpr std::array<const char*, 3> kTypes = {"Pedestrian", "Car", "Cyclist"};
    const int type = row.Integer(column);
    if (type < 1 || type > 3)
      row.Fail("class number " + std::to_string(type) + ": known are 1 Pedestrian 2 Car 3 Cyclist");
    return kTypes[type - 1];
  }
  std::string label(row.Text(column));
  if (ParseNumber(label))
    row.Fail("expected a class name in column " + std::to_string(column + 1) + ", found '" + label +
             "'");
  return label;
}

/// KITTI: rotation_y = 0 points along the camera's x axis; up is the camera's -y axis.
lie::SO3<double> RotationFromYaw(double rotation_y) {
  const double c = std::cos(rotation_y), s = std::sin(rotation_y);
  Eigen::Matrix3d R;
  R << c, s, 0,  //
      0, 0, -1,  //
      -s, c, 0;
  return lie::SO3<double>::FromMatrix(R);
}

/// None: the row is unusable (a value is not finite or a size is not positive). Fills `written` but
/// for the frame.
std::optional<Detection> ParseRow(const TextRows& row, DetectionFormat format,
                                  const Columns& columns, DetectionColumns& written) {
  bool finite = true;
  std::array<double, 18> value{};
  for (int i = 0; i < static_cast<int>(row.size()); ++i) {
    if (i == columns.label) continue;
    value[i] = row.Number(i);
    finite = finite && std::isfinite(value[i]);
  }
  const double* box = &value[columns.box];
  written.box = {box[0], box[1], box[2], box[3]};
  written.alpha = value[columns.alpha];
  written.rotation_y = value[columns.yaw];
  if (columns.score >= 0) written.score = value[columns.score];
  Detection detection;
  detection.label = LabelOf(row, format, columns.label);
  const double h = value[columns.dims], w = value[columns.dims + 1], l = value[columns.dims + 2];
  if (detection.label != "DontCare" && !(finite && h > 0 && w > 0 && l > 0)) return std::nullopt;
  const double* location = &value[columns.location];
  detection.dims = Vec3(l, w, h);
  detection.T_cam_object = Pose(RotationFromYaw(value[columns.yaw]),
                                Vec3(location[0], location[1] - h / 2, location[2]));
  if (written.box.Area() > 0) detection.box = written.box;
  detection.score = written.score;
  return detection;
}

class DetectionReader {
 public:
  explicit DetectionReader(const DetectionReadOptions& options) : options_(options) {}

  /// `frame` < 0: the rows contain the frame number.
  void ReadFile(const std::string& path, int frame);
  DetectionFile Finish();

 private:
  void CheckLayout(const TextRows& row, int frame);
  void CheckScore(const TextRows& row, double score);

  DetectionReadOptions options_;
  DetectionFile out_;
  std::size_t row_size_ = 0;
  bool outside_unit_ = false;  // a score outside [0, 1] was read
  std::string first_dropped_;
};

void DetectionReader::CheckLayout(const TextRows& row, int frame) {
  if (out_.format == DetectionFormat::kNone) {
    out_.format = Guess(row);
    row_size_ = row.size();
    const bool per_frame = out_.format == DetectionFormat::kKittiObject;
    if (per_frame && frame < 0)
      row.Fail("KITTI object rows have no frame number: name the folder of %06d.txt files instead");
    if (!per_frame && frame >= 0)
      row.Fail("these rows have frame numbers of their own: name this file, not its folder");
  }
  const bool is_csv = out_.format == DetectionFormat::kAb3dmotCsv;
  if (row.size() != row_size_ || row.has_commas() != is_csv) {
    row.Fail("found " + std::to_string(row.size()) + " columns " +
             (row.has_commas() ? "with commas" : "without commas") + ", the rows before have " +
             std::to_string(row_size_) + " (" + ToString(out_.format) +
             "): complete or remove the row");
  }
}

void DetectionReader::CheckScore(const TextRows& row, double score) {
  if (score >= 0 && score <= 1) return;
  outside_unit_ = true;
  if (options_.score == ScoreKind::kProbability) {
    row.Fail("score " + std::to_string(score) +
             " is no probability: it lies outside [0, 1]; read the scores as logits");
  }
}

void DetectionReader::ReadFile(const std::string& path, int frame) {
  TextRows row(path);
  while (row.Next()) {
    CheckLayout(row, frame);
    const Columns columns = ColumnsOf(out_.format, row_size_);
    const int row_frame = columns.frame >= 0 ? row.Integer(columns.frame) : frame;
    if (row_frame < 0) row.Fail("negative frame number " + std::to_string(row_frame));
    DetectionColumns& written = out_.columns.emplace_back();
    written.frame = row_frame;
    std::optional<Detection> detection = ParseRow(row, out_.format, columns, written);
    const int row_number = out_.rows++;
    if (!detection) {
      ++out_.dropped;
      if (first_dropped_.empty()) first_dropped_ = ToString(row.where());
    } else if (detection->label == "DontCare") {
      ++out_.dont_care;
    } else {
      CheckScore(row, detection->score);
      detection->row = row_number;
      out_.by_frame[row_frame].push_back(std::move(*detection));
    }
  }
}

DetectionFile DetectionReader::Finish() {
  out_.logits =
      options_.score == ScoreKind::kLogit || (options_.score == ScoreKind::kAuto && outside_unit_);
  const bool has_scores = ColumnsOf(out_.format, row_size_).score >= 0;
  if (out_.logits && has_scores) {
    for (auto& [frame, detections] : out_.by_frame) {
      for (Detection& detection : detections) detection.score = Sigmoid(detection.score);
    }
  }
  if (out_.dropped > 0) {
    out_.warnings.push_back(
        first_dropped_ + ": dropped " + std::to_string(out_.dropped) +
        " detection(s), the first one here: a value is not finite or a size is not positive");
  }
  return std::move(out_);
}

/// KITTI tracking: frame track label truncated occluded alpha, box, h w l, centre of the bottom
/// face, rotation_y, score.
std::string TrackingRow(int frame, const Detection& detection) {
  const Box2d box = detection.box.value_or(Box2d{-1, -1, -1, -1});
  const Vec3& centre = detection.T_cam_object.translation();
  // rotation_y turns about +y, which points down; yaw counts about up.
  const double rotation_y = WrapAngle(-GravityFrame().YawOf(detection.T_cam_object.so3()));
  const double alpha = WrapAngle(rotation_y - std::atan2(centre.x(), centre.z()));
  const Vec3& d = detection.dims;
  std::string row = std::to_string(frame) + " -1 " + detection.label + " -1 -1";
  const auto add = [&row](double value, int decimals) {
    row += " " + FixedNumber(value, decimals);
  };
  add(alpha, 4);
  for (const double side : {box.left, box.top, box.right, box.bottom}) add(side, 2);
  for (const double size : {d.z(), d.y(), d.x()}) add(size, 4);
  for (const double position : {centre.x(), centre.y() + 0.5 * d.z(), centre.z()}) add(position, 4);
  add(rotation_y, 5);
  add(detection.score, 3);
  return row + "\n";
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, DetectionReadOptions& options) {
  visitor.Enum("score", options.score, {"auto", "probability", "logit"},
               "meaning of the score column; auto: logits if any score lies outside [0, 1]");
}

const char* ToString(DetectionFormat format) {
  switch (format) {
    case DetectionFormat::kNone: return "no rows";
    case DetectionFormat::kKittiObject: return "KITTI object";
    case DetectionFormat::kKittiTracking: return "KITTI tracking";
    case DetectionFormat::kAb3dmotCsv: return "AB3DMOT csv";
  }
  return "";
}

DetectionFile ReadDetections(const std::string& path, const DetectionReadOptions& options) {
  DetectionReader reader(options);
  if (IsFolder(path)) {
    const std::vector<NumberedFile> files = NumberedFiles(path, ".txt");
    if (files.empty())
      throw Error(ErrorKind::kBadInput, {path}, "no files named by frame number (000000.txt, ...)");
    for (const NumberedFile& file : files) reader.ReadFile(file.path, file.number);
  } else {
    reader.ReadFile(path, -1);
  }
  return reader.Finish();
}

std::string DetectionsText(const std::vector<std::vector<Detection>>& by_frame) {
  std::string text;
  for (std::size_t frame = 0; frame < by_frame.size(); ++frame)
    for (const Detection& detection : by_frame[frame])
      text += TrackingRow(static_cast<int>(frame), detection);
  return text;
}

}  // namespace sslcd
