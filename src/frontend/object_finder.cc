// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/object_finder.h"

#include <algorithm>
#include <utility>

#include "detectors/model_description.h"
#include "sslcd/core/error.h"

namespace sslcd {

ObjectFinder::ObjectFinder(const StereoCamera& camera, const VisionOptions& options,
                           const ColourOptions& colour, std::optional<BoxesByFrame> boxes)
    : camera_(camera), lift_(options.lift), colour_(colour), boxes_(std::move(boxes)) {
  if (!boxes_) {
    if (options.detector.empty())
      throw Error(
          ErrorKind::kUsage,
          "nothing to make detections from: name a detector's description (--detector, "
          "docs/models.md) or a "
          "file of 2D boxes (--boxes), or ask for odometry alone (detect --odometry stereo)");
    if (TaskOf(LoadModelDescription(options.detector).output.layout) == ModelTask::kDetect3d)
      detector_3d_.emplace(Detector3d::Load(options.detector, options.inference));
    else
      detector_2d_.emplace(Detector2d::Load(options.detector, options.inference));
    if (detector_2d_)
      lift_.box_sigma_share = std::max(lift_.box_sigma_share, detector_2d_->box_sigma());
  }
  if (!options.embedder.empty())
    embedder_.emplace(Embedder::Load(options.embedder, options.inference));
}

std::vector<Detection> ObjectFinder::Lift(int frame, const StereoView& images,
                                          FrontendReport& report) const {
  std::vector<ImageDetection> boxes;
  if (detector_2d_) {
    boxes = detector_2d_->Detect(images.left, &report.timing);
  } else if (const auto given = boxes_->find(frame); given != boxes_->end()) {
    boxes = given->second;
  }
  const ScopedTimer timer(report.timing, "stereo lifting");
  std::vector<Detection> detections;
  for (LiftedBox& box : LiftBoxes(images, camera_, boxes, lift_)) {
    ++report.lift[box.status];
    if (box.status == LiftStatus::kUnknownLabel) report.unknown.insert(box.detection.label);
    if (box.status == LiftStatus::kLifted) detections.push_back(std::move(box.detection));
  }
  return detections;
}

std::vector<Detection> ObjectFinder::Find(int frame, const StereoView& images,
                                          FrontendReport& report) const {
  std::vector<Detection> detections = detector_3d_
                                          ? detector_3d_->Detect(images, camera_, &report.timing)
                                          : Lift(frame, images, report);
  std::vector<Box2d> boxes;
  for (const Detection& detection : detections) boxes.push_back(detection.box.value_or(Box2d()));
  if (embedder_) {
    std::vector<std::vector<float>> vectors = embedder_->Embed(images.left, boxes, &report.timing);
    for (std::size_t i = 0; i < detections.size(); ++i)
      detections[i].appearance[Cue::kEmbedding] = std::move(vectors[i]);
  }
  if (images.left.channels == 3) {
    const ScopedTimer timer(report.timing, "colour");
    for (std::size_t i = 0; i < detections.size(); ++i)
      detections[i].appearance[Cue::kColour] = ColourVector(images.left, boxes[i], colour_);
  }
  return detections;
}

}  // namespace sslcd
