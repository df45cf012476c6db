// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/datasets/dataset.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/turning_axis.h"
#include "datasets/dataset_images.h"
#include "datasets/dataset_layout.h"
#include "datasets/groundtruth.h"
#include "datasets/oxts.h"
#include "datasets/sequence_yaml.h"
#include "datasets/stamps.h"
#include "datasets/tracklets.h"
#include "formats/calib.h"
#include "formats/file_set.h"
#include "formats/files.h"
#include "formats/npy.h"
#include "formats/number_text.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::string AxisText(const Vec3& axis) {
  std::string text;
  for (const double value : {axis.x(), axis.y(), axis.z()})
    text += (text.empty() ? "[" : ", ") + RoundedNumber(value + 0., 2);
  return text + "]";
}

constexpr double kKittiFrameStep = 0.1;  // [s]

bool IsOxts(const std::string& path) {
  if (IsFolder(path)) return true;
  TextRows row(path);
  return row.Next() && row.size() == 30;
}

bool IsTracklets(const std::string& path) {
  return path.size() > 4 && path.substr(path.size() - 4) == ".xml";
}

PoseFile ReadPoses(const std::string& path, const Calibration& calibration) {
  if (!IsOxts(path)) return ReadPoseFile(path);
  PoseFile file;
  file.format = PoseFormat::kKitti;
  file.trajectory.poses = ReadOxtsCamera(path, calibration);
  for (std::size_t i = 0; i < file.trajectory.size(); ++i)
    file.trajectory.stamps.push_back(static_cast<double>(i));
  file.steps.resize(file.trajectory.size());
  return file;
}

// What the rows after `from`, up to `to`, report of the step from one to the other.
std::optional<StepUncertainty> StepOver(const PoseFile& file, std::size_t from, std::size_t to) {
  std::optional<StepUncertainty> sum;
  for (std::size_t row = from + 1; row <= to; ++row) {
    if (!file.steps[row]) continue;
    if (!sum) sum.emplace();
    sum->lost = sum->lost || file.steps[row]->lost;
    sum->translation_m = std::hypot(sum->translation_m, file.steps[row]->translation_m);
    sum->rotation_rad = std::hypot(sum->rotation_rad, file.steps[row]->rotation_rad);
  }
  return sum;
}

class DatasetLoader {
 public:
  explicit DatasetLoader(const DatasetRequest& request)
      : request_(request), layout_(FindDatasetLayout(request)) {}

  Dataset Load() {
    out_.format = layout_.format;
    out_.name = layout_.name;
    out_.parts = PartsOf(layout_);
    out_.groundtruth_boxes_path = layout_.groundtruth_boxes;
    images_ = {ListImages(layout_.images), ListImages(layout_.images_right)};
    if (!layout_.sequence_yaml.empty()) info_ = ReadSequenceYaml(layout_.sequence_yaml);
    out_.labels = info_.labels;
    if (!layout_.calib.empty()) calibration_ = layout_.read_calibration(layout_.calib);
    layout_.odometry.empty() ? AddFramesWithoutPoses() : AddFrames();
    out_.camera = calibration_.left;
    out_.camera_right = calibration_.right;
    const std::size_t frames = out_.frames.size();
    AddImages(layout_, images_, info_, frames_in_file_, out_);
    if (out_.frames.size() < frames) frames_in_file_ = out_.frames.size();
    WarnOfMoreImages();
    if (!layout_.detections.empty()) AddDetections();
    AddGroundtruth();
    return std::move(out_);
  }

 private:
  void AddFrames();
  void AddFramesWithoutPoses();
  void AddDetections();
  void AddAppearance();
  int AddVectors(const std::string& path, Cue cue);  // returns the number of unusable vectors
  void WarnOfMoreImages();
  void CheckLabels();
  void AddGroundtruth();
  void Warn(const std::string& text) { out_.warnings.push_back(text); }

  DatasetRequest request_;
  DatasetLayout layout_;
  Calibration calibration_;
  SequenceInfo info_;
  SequenceImages images_;
  std::size_t frames_in_file_ = 0;  // before max_frames
  double last_stamp_ = 0;           // of the last of them [s]
  Dataset out_;
};

void DatasetLoader::AddFrames() {
  PoseFile odometry = ReadPoses(layout_.odometry, calibration_);
  out_.odometry_path = layout_.odometry;
  out_.odometry_format = odometry.format;
  if (odometry.trajectory.poses.empty()) {
    throw Error(ErrorKind::kBadInput, {layout_.odometry},
                "holds no poses: there is nothing to run on");
  }
  const bool is_vins = odometry.format == PoseFormat::kVinsCsv;
  out_.up_axis = info_.up_axis.value_or(is_vins ? Vec3(0, 0, 1) : Vec3(0, -1, 0));
  if (is_vins) Warn(layout_.odometry + ": VINS-Fusion csv; its poses are taken as the camera's");
  const bool has_stamps = odometry.format != PoseFormat::kKitti;
  std::vector<double> stamps = odometry.trajectory.stamps;
  std::vector<std::size_t> rows(stamps.size());  // of the odometry, by frame
  std::iota(rows.begin(), rows.end(), 0);
  if (!layout_.times.empty()) {
    stamps = layout_.read_times(layout_.times);
    if (stamps.empty())
      throw Error(ErrorKind::kBadInput, {layout_.times},
                  "holds no stamps: fill or remove the file");
    if (has_stamps) {
      rows = NearestPoses(stamps, odometry.trajectory, layout_.odometry);
      const std::vector<double>& given = odometry.trajectory.stamps;
      const auto late = given.end() - std::upper_bound(given.begin(), given.end(),
                                                       stamps.back() + 0.5 * MedianStep(stamps));
      if (late > 0)
        Warn(layout_.odometry + ": " + std::to_string(late) + " poses come after the last of " +
             layout_.times);
    } else if (stamps.size() != rows.size()) {
      throw Error(ErrorKind::kBadInput, {layout_.odometry},
                  "has " + std::to_string(rows.size()) + " poses, but " + layout_.times + " has " +
                      std::to_string(stamps.size()) + " stamps: give one pose per frame");
    }
  } else if (!has_stamps && images_.left.by_stamp) {
    stamps = StampsOfPoses(images_.left, rows.size(), layout_.odometry);
  } else if (!has_stamps) {
    for (double& stamp : stamps) stamp *= kKittiFrameStep;
  }
  if (const auto warning = GapWarning(stamps)) Warn(*warning);
  if (layout_.odometry_is_truth) {
    Warn("no odometry named: the ground truth (" + layout_.odometry + ") is used as odometry");
  }

  frames_in_file_ = rows.size();
  last_stamp_ = stamps.back();
  const std::size_t limit =
      request_.max_frames > 0 ? static_cast<std::size_t>(request_.max_frames) : rows.size();
  out_.frames.resize(std::min(rows.size(), limit));
  for (std::size_t i = 0; i < out_.frames.size(); ++i) {
    out_.frames[i].index = static_cast<int>(i);
    out_.frames[i].stamp = stamps[i];
    out_.frames[i].T_odom_cam = odometry.trajectory.poses[rows[i]];
    if (i > 0) out_.frames[i].step = StepOver(odometry, rows[i - 1], rows[i]);
  }
  if (!MayBeUp(out_.up_axis, odometry.trajectory.poses))
    Warn(layout_.odometry + ": the camera turns about " +
         AxisText(*TurningAxis(odometry.trajectory.poses)) + ", but up is taken to be " +
         AxisText(out_.up_axis) + ": name the right up_axis in sequence.yaml");
}

void DatasetLoader::AddFramesWithoutPoses() {
  // The world is the first camera; up_axis of sequence.yaml refers to odometry.txt.
  out_.up_axis = Vec3(0, -1, 0);
  std::vector<double> stamps;
  if (!layout_.times.empty()) {
    stamps = layout_.read_times(layout_.times);
  } else {
    stamps = StampsOfImages(images_.left, kKittiFrameStep);
  }
  if (stamps.empty())
    throw Error(ErrorKind::kBadInput, {request_.path},
                "no frames: odometry from images needs times.txt or a folder of left images" +
                    std::string(images_.left.others > 0
                                    ? "; those in " + layout_.images +
                                          " have names without a number: name them by frame "
                                          "(000000.png) or by stamp (1403636579.763555.png)"
                                    : " (left, image_2 or image_0)"));
  if (const auto warning = GapWarning(stamps)) Warn(*warning);
  frames_in_file_ = stamps.size();
  const std::size_t limit =
      request_.max_frames > 0 ? static_cast<std::size_t>(request_.max_frames) : stamps.size();
  out_.frames.resize(std::min(stamps.size(), limit));
  for (std::size_t i = 0; i < out_.frames.size(); ++i) {
    out_.frames[i].index = static_cast<int>(i);
    out_.frames[i].stamp = stamps[i];
  }
}

void DatasetLoader::WarnOfMoreImages() {
  const int more = layout_.odometry.empty() || out_.frames.empty()
                       ? 0
                       : ImagesAfter(images_.left, frames_in_file_, last_stamp_);
  if (more == 0) return;
  const std::string count = std::to_string(frames_in_file_);
  Warn((layout_.times.empty() ? layout_.odometry + ": has " + count + " poses"
                              : layout_.times + ": has " + count + " stamps") +
       ", and " + layout_.images + " " + std::to_string(more) + " more images; they are left out");
}

void DatasetLoader::AddDetections() {
  out_.detections_path = layout_.detections;
  DetectionFile file;
  if (IsTracklets(layout_.detections)) {
    if (!calibration_.T_cam_velo) {
      throw Error(ErrorKind::kBadInput, {layout_.detections},
                  "tracklets are in the lidar's frame: add calib_cam_to_cam.txt and "
                  "calib_velo_to_cam.txt to the drive or "
                  "the folder above it");
    }
    file.by_frame = TrackletDetections(ReadTracklets(layout_.detections), *calibration_.T_cam_velo);
    for (const auto& [frame, detections] : file.by_frame)
      file.rows += static_cast<int>(detections.size());
    Warn("the detections are the drive's hand-labelled tracklets (" + layout_.detections + ")");
  } else {
    file = ReadDetections(layout_.detections, request_.detection_options);
  }
  out_.rows_read = file.rows;
  out_.rows_dropped = file.dropped;
  out_.rows_dont_care = file.dont_care;
  out_.warnings.insert(out_.warnings.end(), file.warnings.begin(), file.warnings.end());

  for (auto& [frame, detections] : file.by_frame) {
    if (static_cast<std::size_t>(frame) >= frames_in_file_)
      out_.rows_beyond_end += static_cast<int>(detections.size());
    if (static_cast<std::size_t>(frame) < out_.frames.size())
      out_.frames[frame].detections = std::move(detections);
  }
  if (file.by_frame.empty())
    Warn(layout_.detections + " holds no detections that can be used: the map will be empty");
  if (out_.rows_beyond_end > 0) {
    Warn(layout_.detections + ": dropped " + std::to_string(out_.rows_beyond_end) +
         " detections of frames after the last pose (" + std::to_string(frames_in_file_ - 1) + ")");
  }
  AddAppearance();
  CheckLabels();
}

int DatasetLoader::AddVectors(const std::string& path, Cue cue) {
  const NpyMatrix matrix = ReadNpy(path);
  if (matrix.rows != static_cast<std::size_t>(out_.rows_read)) {
    throw Error(ErrorKind::kBadInput, {path},
                "has " + std::to_string(matrix.rows) + " rows, but " + layout_.detections +
                    " has " + std::to_string(out_.rows_read) + ": give one row per detection row");
  }
  int unusable = 0;
  for (Frame& frame : out_.frames) {
    for (Detection& detection : frame.detections) {
      const float* row = matrix.Row(static_cast<std::size_t>(detection.row));
      double squares = 0;
      for (std::size_t i = 0; i < matrix.columns; ++i) squares += double(row[i]) * row[i];
      if (!(std::isfinite(squares) && squares > 0)) {
        ++unusable;
        continue;
      }
      std::vector<float>& vector = detection.appearance[cue];
      vector.assign(row, row + matrix.columns);
      for (float& value : vector) value = static_cast<float>(value / std::sqrt(squares));
    }
  }
  return unusable;
}

void DatasetLoader::AddAppearance() {
  for (const CueRow& row : kCueRows) {
    const std::string& path = layout_.appearance[row.cue];
    out_.appearance_paths[row.cue] = path;
    const int unusable = path.empty() ? 0 : AddVectors(path, row.cue);
    if (unusable == 0) continue;
    const std::string count = std::to_string(unusable), name = row.name;
    if (row.complete)
      throw Error(ErrorKind::kBadInput, {path},
                  count + " " + name +
                      " vector(s) are zero or not finite: give every detection its " + name +
                      ", or remove the file");
    Warn(path + ": left out " + count + " " + name + "(s) that are zero or not finite");
  }
}

/// A label that sequence.yaml lacks is probably misspelt in one of the two files.
void DatasetLoader::CheckLabels() {
  if (out_.labels.entries().empty()) return;
  std::set<std::string> unknown;
  for (const Frame& frame : out_.frames) {
    for (const Detection& detection : frame.detections) {
      if (out_.labels.entries().count(detection.label) == 0) unknown.insert(detection.label);
    }
  }
  if (unknown.empty()) return;
  Warn(layout_.sequence_yaml + ": not among its labels: " + Join({unknown.begin(), unknown.end()}) +
       "; their symmetry is none");
}

void DatasetLoader::AddGroundtruth() {
  if (layout_.groundtruth.empty()) return;
  if (request_.groundtruth.empty() && IsOxts(layout_.groundtruth) && !calibration_.HasImu()) {
    Warn(layout_.groundtruth +
         ": not used as ground truth, because the calibration lacks the transform from IMU to "
         "camera");
    return;
  }
  out_.groundtruth =
      GroundtruthOfFrames(ReadPoses(layout_.groundtruth, calibration_), layout_.groundtruth,
                          out_.frames, frames_in_file_, out_.warnings);
  out_.groundtruth_path = layout_.groundtruth;
}

}  // namespace

Dataset LoadDataset(const DatasetRequest& request) {
  RefuseUnfinished(request.path);
  return DatasetLoader(request).Load();
}

}  // namespace sslcd
