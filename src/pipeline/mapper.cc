// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/mapper.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/close_loops.h"
#include "pipeline/leveller.h"
#include "pipeline/refine.h"
#include "pipeline/view_ties.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

Pose Scaled(const Pose& T, double log_scale) {
  return Pose(T.so3(), T.translation() * std::exp(log_scale));
}

// A camera's step according to the odometry, made metric.
Pose Step(const FrameRecord& from, const Pose& T_odom_cam, double log_scale) {
  return Scaled(from.T_odom_cam.inverse() * T_odom_cam, log_scale);
}

}  // namespace

Mapper::Mapper(const Options& options, const MapperContext& context)
    : options_(options),
      context_(context),
      map_(context.gravity, context.labels, options.noise, options.association, options.map),
      leveller_(std::make_unique<Leveller>(context.gravity, options.level)),
      loops_(std::make_unique<LoopCloser>(options, map_, frames_, context_.place_matcher)) {}

Mapper::~Mapper() = default;

double Mapper::scale() const { return std::exp(log_scale_); }

FrameReport Mapper::AddFrame(const Frame& frame) {
  const Vec6 log = frame.T_odom_cam.Log();
  if (!std::isfinite(log.sum()) || !std::isfinite(frame.stamp))
    throw Error(ErrorKind::kBadInput,
                "frame " + std::to_string(frame.index) + ": its pose or stamp is not finite");
  if (!frames_.empty() && frame.stamp <= frames_.back().stamp)
    throw Error(ErrorKind::kBadInput, "frame " + std::to_string(frame.index) + ": its stamp " +
                                          std::to_string(frame.stamp) +
                                          " s is not after the one before it");
  FrameReport report;
  const Pose T_odom_cam = leveller_->Level(frame.T_odom_cam);
  double travelled = 0;
  if (!frames_.empty()) {
    const FrameRecord& before = frames_.back();
    travelled =
        before.travelled + (T_odom_cam.translation() - before.T_odom_cam.translation()).norm();
  }
  FrameRecord record{frame.index,         frame.stamp,      travelled, T_odom_cam,
                     Predict(T_odom_cam), frame.detections, {}};
  {
    const ScopedTimer timer(timing_, "data association");
    report.filter = FilterDetections(record.detections, options_.filter);
    const Camera* camera = context_.camera ? &*context_.camera : nullptr;
    report.map = map_.AddFrame(frame.index, frame.stamp, record.T_world_cam, record.detections,
                               camera, travelled);
    record.matched = report.map.matched;
  }
  report.keyframe = IsKeyframe(T_odom_cam);
  frames_.push_back(std::move(record));
  if (options_.loop.enabled) loops_->AddFrame();
  for (Detection& detection :
       frames_.back()
           .detections) {  // kept for associating anew at the end: what was seen, not how it looked
    detection.colour.clear();
    detection.embedding.clear();
  }
  if (report.keyframe) {
    window_.push_back(static_cast<int>(frames_.size()) - 1);
    if (options_.window.enabled) {
      const ScopedTimer timer(timing_, "object optimisation");
      loops_->MovedFrom(window_.front());
      report.window = OptimiseWindow();
    }
    if (options_.loop.enabled && loops_->AddKeyframe(scale(), timing_)) ResetWindow();
  }
  report.T_world_cam = frames_.back().T_world_cam;
  return report;
}

Pose Mapper::Predict(const Pose& T_odom_cam) const {
  if (frames_.empty()) return T_odom_cam;
  return frames_.back().T_world_cam * Step(frames_.back(), T_odom_cam, log_scale_);
}

bool Mapper::IsKeyframe(const Pose& T_odom_cam) const {
  if (window_.empty()) return true;
  const Pose step = frames_[window_.back()].T_odom_cam.inverse() * T_odom_cam;
  return step.translation().norm() >= options_.window.keyframe_m ||
         step.so3().Log().norm() >= options_.window.keyframe_rad;
}

BaProblem Mapper::WindowProblem() const {
  BaProblem problem;
  problem.gravity = context_.gravity;
  problem.noise = options_.noise;
  problem.noise_scale = map_.noise_scale();
  problem.log_scale = log_scale_;
  problem.expected_log_scale = refined_log_scale_;
  problem.prior = prior_;
  for (std::size_t i = 0; i < window_.size(); ++i) {
    const FrameRecord& record = frames_[window_[i]];
    problem.cameras.push_back({record.frame, record.T_world_cam});
    if (i == 0) continue;
    const FrameRecord& before = frames_[window_[i - 1]];
    problem.odometry.push_back({static_cast<int>(i) - 1, static_cast<int>(i),
                                before.T_odom_cam.inverse() * record.T_odom_cam});
  }

  std::set<int> ids(prior_.object_ids.begin(), prior_.object_ids.end());
  for (const int keyframe : window_) {
    for (const LandmarkId id : frames_[keyframe].matched) {
      const auto known = map_.landmarks().find(id.value);
      if (known == map_.landmarks().end() || known->second.state != LandmarkState::kConfirmed)
        continue;
      if (static_cast<int>(known->second.sightings.size()) >= options_.window.min_sightings)
        ids.insert(id.value);
    }
  }
  for (const int id : ids) {
    const MapLandmark& landmark = map_.landmarks().at(id);
    const int object = static_cast<int>(problem.objects.size());
    problem.objects.push_back({id, landmark.symmetry, landmark.pose});
    for (std::size_t i = 0; i < window_.size(); ++i) {
      const int frame = problem.cameras[i].frame;
      const auto at =
          std::lower_bound(landmark.sightings.begin(), landmark.sightings.end(), frame,
                           [](const Sighting& sighting, int f) { return sighting.frame < f; });
      if (at != landmark.sightings.end() && at->frame == frame &&
          landmark.state == LandmarkState::kConfirmed)
        problem.sightings.push_back({static_cast<int>(i), object, at->T_cam_object});
    }
  }
  return problem;
}

BaSummary Mapper::OptimiseWindow() {
  BaProblem problem = WindowProblem();
  problem.hold_first = true;
  const BaSummary summary = SolveBa(problem, options_.ba);
  problem.hold_first = false;
  if (summary.usable) {
    for (std::size_t i = 0; i < window_.size(); ++i)
      frames_[window_[i]].T_world_cam = problem.cameras[i].T_world_cam;
    for (const BaObject& object : problem.objects)
      if (map_.landmarks().at(object.id).state == LandmarkState::kConfirmed)
        map_.SetPose({object.id}, object.pose);
    log_scale_ = problem.log_scale;
  }
  if (static_cast<int>(window_.size()) >= options_.window.keyframes) SlideWindow(problem);
  return summary;
}

// The oldest camera leaves, and with it the objects that no camera of the window sees any more;
// what they said of the others stays as a prior.
void Mapper::SlideWindow(const BaProblem& problem) {
  std::vector<int> gone_objects;
  for (int k = 0; k < static_cast<int>(problem.objects.size()); ++k) {
    const bool seen =
        std::any_of(problem.sightings.begin(), problem.sightings.end(),
                    [k](const BaSighting& s) { return s.object == k && s.camera > 0; });
    if (!seen) gone_objects.push_back(k);
  }
  prior_ = Marginalise(problem, {0}, gone_objects, options_.ba);
  const int left_behind = window_.front();
  window_.erase(window_.begin());
  Propagate(left_behind);
}

// Frames between keyframes follow the keyframe before them.
void Mapper::Propagate(std::size_t from_record) {
  const std::size_t to = window_.empty() ? frames_.size() : window_.front();
  for (std::size_t i = from_record + 1; i < to; ++i)
    frames_[i].T_world_cam =
        frames_[i - 1].T_world_cam * Step(frames_[i - 1], frames_[i].T_odom_cam, log_scale_);
}

BaSummary Mapper::Refine() {
  const Camera* camera = context_.camera ? &*context_.camera : nullptr;
  Options options = options_;
  LoopEvidence loops;
  const auto adjust = [&] {
    const ScopedTimer timer(timing_, "full-map optimisation");
    const BaSummary summary = RefineMap(map_, frames_, log_scale_, loops, options, camera);
    refined_log_scale_ = log_scale_;
    loops_->Review();
    ResetWindow();
    return summary;
  };
  if (options_.loop.enabled) loops_->Finish(scale(), timing_);
  if (loops_->Closed()) {  // what the loops have bent must stay bent
    options.ba.odometry = options_.loop.odometry;
    loops.odometry_factors = loops_->LearnOdometry(scale());
  }
  view_ties_.clear();
  BaSummary summary = adjust();
  const bool align = options_.loop.enabled && options_.loop.views.enabled &&
                     options_.mode != Options::Mode::kPaper;
  if (!context_.view_aligner || !align) return summary;
  {
    const ScopedTimer timer(timing_, "view alignment");
    loops.view_ties = TieViews(frames_, loops_->Path(), context_.view_aligner, options_.loop);
  }
  if (loops.view_ties.empty()) return summary;
  summary = adjust();
  view_ties_ = Agreeing(loops.view_ties, frames_);
  loops_->MeasureByViews(view_ties_, scale());
  return summary;
}

// After poses have moved that the window's prior speaks of.
void Mapper::ResetWindow() {
  prior_ = {};
  if (!window_.empty()) window_.erase(window_.begin(), window_.end() - 1);
}

std::vector<LoopClosure> Mapper::LoopClosures() const { return loops_->closures(); }

Trajectory Mapper::CameraTrajectory() const {
  Trajectory trajectory;
  for (const FrameRecord& record : frames_) {
    trajectory.stamps.push_back(record.stamp);
    trajectory.poses.push_back(record.T_world_cam);
  }
  return trajectory;
}

std::vector<MapObject> Mapper::Objects() const {
  std::vector<MapObject> objects;
  for (const auto& [id, landmark] : map_.landmarks()) {
    MapObject object;
    object.id = landmark.id;
    object.label = landmark.label;
    object.state = landmark.state;
    object.T_world_object = ToPose(landmark.pose, context_.gravity);
    object.dims = landmark.dims;
    for (const Sighting& sighting : landmark.sightings)
      object.observations.push_back({sighting.frame, sighting.detection_row});
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace sslcd
