// SPDX-License-Identifier: BSD-3-Clause
#include "check/repaired_files.h"

#include <algorithm>

#include "sslcd/core/error.h"

namespace sslcd::check {
namespace {

void RefuseWhatStays(const CheckReport& report) {
  if (report.mistakes() == 0)
    throw Error(ErrorKind::kBadInput,
                report.repaired.name + ": no mistake found: nothing to correct");
  for (const CheckReport::Line& line : report.lines) {
    const auto& mistake = line.outcome.mistake;
    if (mistake && !(mistake->repair && MistakeOf(mistake->id).repairable))
      throw Error(ErrorKind::kBadInput,
                  report.repaired.name + ": " + mistake->id +
                      " cannot be corrected from the data: " + MistakeOf(mistake->id).fix);
  }
  for (const auto& step : report.repaired.steps)
    if (step)
      throw Error(ErrorKind::kBadInput,
                  report.repaired.odometry_path +
                      ": reports how uncertain its steps are, which --fix does not write: correct "
                      "this file by hand");
}

/// A sequence folder has both cameras of a pair; one that is alone is written twice.
StereoCamera CameraPairOf(const Sequence& sequence) {
  StereoCamera stereo;
  stereo.left = *sequence.camera;
  if (sequence.camera_right)
    stereo.baseline_m =
        std::max(0., sequence.camera->offset.x() - sequence.camera_right->offset.x());
  return stereo;
}

}  // namespace

SequenceFiles RepairedFiles(const CheckReport& report) {
  RefuseWhatStays(report);
  const Sequence& sequence = report.repaired;
  SequenceFiles files;
  files.comment = "corrected by sslcd_run check --fix";
  if (sequence.camera) files.camera = CameraPairOf(sequence);
  files.odometry = {sequence.stamps, sequence.poses};
  files.groundtruth = sequence.groundtruth;
  files.up_axis = sequence.up_axis;
  files.labels = sequence.labels;
  files.detections.resize(sequence.poses.size());
  for (const Row& row : sequence.rows)
    if (row.frame >= 0 && row.frame < sequence.frames())
      files.detections[static_cast<std::size_t>(row.frame)].push_back(row.detection);
  return files;
}

}  // namespace sslcd::check
