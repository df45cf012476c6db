// SPDX-License-Identifier: BSD-3-Clause
#include "map/object_map.h"

#include <algorithm>
#include <cmath>

#include "map/noise_learning.h"

namespace sslcd {

namespace {

// Sightings of a landmark before its position is used to learn the noise. Set by hand.
constexpr int kLearnAfter = 3;

}  // namespace

void DescribeFields(FieldVisitor& visitor, MapOptions& options) {
  visitor.Everyday("higher: fewer false landmarks, but objects seen briefly are missing")
      .Integer("confirm_sightings", options.confirm_sightings, 1, 1000,
               "sightings that turn a tentative landmark into a confirmed one");
  visitor.Everyday("higher: fewer false landmarks, but fewer objects for loops")
      .Real("birth_score", options.birth_score, 0, 1,
            "a detection with a lower score makes no new landmark");
  visitor.Real("stale_after_s", options.stale_after_s, 0, 1e6,
               "a tentative or driving object unseen for longer is dropped");
  visitor.Real("search_radius_m", options.search_radius_m, 0.1, 1000,
               "the landmark of a detection is searched for within this distance");
  visitor.Real("memory_m", options.memory_m, 0, 1e6,
               "after this length of path out of sight, only loop closure finds a landmark again");
  visitor.Flag("learn_noise", options.learn_noise,
               "learn the detector's noise scale from the scatter of its detections");
  visitor.Nested("motion", options.motion, "the test of whether an object is parked or driving");
}

ObjectMap::ObjectMap(const GravityFrame& gravity, const LabelTable& labels,
                     const DetectionNoise& noise, const AssociationOptions& association,
                     const MapOptions& options)
    : gravity_(gravity),
      labels_(labels),
      noise_(noise),
      association_(association),
      options_(options),
      noise_scale_(NoiseScale::Uniform(noise.initial_scale)),
      landmarks_(gravity, options.motion) {}

MapUpdate ObjectMap::AddFrame(int frame, double stamp, const Pose& T_world_cam,
                              const std::vector<Detection>& detections, const Camera* camera,
                              double travelled_m) {
  const FrameView view{frame, stamp, travelled_m, T_world_cam, camera};
  landmarks_.IndexOpen(stamp);

  const std::vector<AssociationQuery> queries = QueriesOf(detections, view);
  std::vector<LandmarkId> ids;
  for (const LandmarkId id : CandidateIds(queries))
    if (travelled_m - landmarks_.at(id).last_seen_at <= options_.memory_m) ids.push_back(id);

  MapUpdate update;
  update.matched = MatchIds(queries, ids, view);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    LandmarkId& id = update.matched[i];
    if (id.value >= 0) {
      MapLandmark& landmark = landmarks_.at(id);
      Update(landmark, queries[i], view);
      UpdateState(landmark, update);
    } else if (detections[i].score >= options_.birth_score) {
      id = Create(queries[i], view);
      ++update.born;
    }
  }
  landmarks_.Retire(stamp, options_.stale_after_s);
  return update;
}

std::vector<LandmarkId> ObjectMap::Match(double stamp, const Pose& T_world_cam,
                                         const std::vector<Detection>& detections,
                                         const Camera* camera,
                                         const std::function<bool(const MapLandmark&)>& may) const {
  const FrameView view{0, stamp, 0., T_world_cam, camera};
  const std::vector<AssociationQuery> queries = QueriesOf(detections, view);
  std::vector<LandmarkId> ids;
  for (const LandmarkId id : CandidateIds(queries))
    if (landmarks_.at(id).state == LandmarkState::kConfirmed && (!may || may(landmarks_.at(id))))
      ids.push_back(id);
  return MatchIds(queries, ids, view);
}

// The landmark of each query among `ids`; -1: none.
std::vector<LandmarkId> ObjectMap::MatchIds(const std::vector<AssociationQuery>& queries,
                                            const std::vector<LandmarkId>& ids,
                                            const FrameView& view) const {
  std::vector<AssociationCandidate> candidates;
  for (const LandmarkId id : ids)
    candidates.push_back(CandidateOf(landmarks_.at(id), view, gravity_, options_.motion));
  std::vector<LandmarkId> matched;
  for (const int k : Associate(queries, candidates, association_))
    matched.push_back(k >= 0 ? ids[k] : LandmarkId{});
  return matched;
}

std::vector<AssociationQuery> ObjectMap::QueriesOf(const std::vector<Detection>& detections,
                                                   const FrameView& view) const {
  std::vector<AssociationQuery> queries;
  for (const Detection& detection : detections)
    queries.push_back(QueryOf(detection, view.T_world_cam, gravity_, noise_, noise_scale_));
  return queries;
}

std::vector<LandmarkId> ObjectMap::CandidateIds(
    const std::vector<AssociationQuery>& queries) const {
  std::vector<LandmarkId> ids;
  for (const AssociationQuery& query : queries) {
    const auto near = landmarks_.FindWithin(query.place.position, options_.search_radius_m);
    ids.insert(ids.end(), near.begin(), near.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

LandmarkId ObjectMap::Create(const AssociationQuery& query, const FrameView& view) {
  MapLandmark landmark;
  landmark.label = query.detection->label;
  landmark.symmetry = labels_[landmark.label].symmetry;
  landmark.pose = ToUpright(view.T_world_cam * query.detection->T_cam_object, gravity_);
  const Gallery::Mode mode = association_.method == AssociationOptions::Method::kPaper
                                 ? Gallery::Mode::kMean
                                 : Gallery::Mode::kByViewpoint;
  landmark.appearance = PerCue<Gallery>(Gallery(mode));
  const LandmarkId id = Insert(std::move(landmark));
  Update(landmarks_.at(id), query, view);
  return id;
}

void ObjectMap::Update(MapLandmark& landmark, const AssociationQuery& query,
                       const FrameView& view) {
  const Detection& detection = *query.detection;
  if (options_.learn_noise && landmark.sightings.size() >= kLearnAfter &&
      landmark.state == LandmarkState::kConfirmed)
    LearnNoise(landmark, detection, view.T_world_cam, gravity_, noise_, noise_scale_);

  landmark.motion.Add(query.place.position, query.place.covariance, view.stamp, options_.motion);
  for (const CueRow& row : kCueRows)
    landmark.appearance[row.cue].Add(detection.appearance[row.cue], query.viewpoint_rad);
  landmark.sightings.push_back(SightingOf(view.frame, view.stamp, detection));
  landmark.last_seen = view.stamp;
  landmark.last_seen_at = view.travelled_m;

  // Running estimate before bundle adjustment: the position of the motion test, and the mean of
  // height and yaw.
  const double share = 1. / landmark.sightings.size();
  const UprightPose seen = ToUpright(view.T_world_cam * detection.T_cam_object, gravity_);
  const bool driving = landmark.state == LandmarkState::kDynamic;
  const Vec2 place = driving ? landmark.motion.PredictDriving(view.stamp, options_.motion).position
                             : landmark.motion.PredictParked(view.stamp, options_.motion).position;
  const double height = landmark.pose.position.dot(gravity_.up);
  landmark.pose.position = place.x() * gravity_.forward + place.y() * gravity_.left +
                           (height + share * (query.height - height)) * gravity_.up;
  landmark.pose.yaw =
      driving
          ? seen.yaw
          : WrapAngle(landmark.pose.yaw + share * WrapAngle(seen.yaw - landmark.pose.yaw, M_PI));
  landmark.dims = FuseDims(landmark.sightings);
  landmarks_.Index(landmark, view.stamp);
}

void ObjectMap::UpdateState(MapLandmark& landmark, MapUpdate& update) {
  const Motion motion =
      CanMove(landmark) ? landmark.motion.Verdict(options_.motion) : Motion::kParked;
  if (landmark.state == LandmarkState::kDynamic) {
    // A driving object that stops becomes a new object without its history and may become part of
    // the map.
    const double since = landmark.motion.StandingSince();
    if (landmark.motion.Stamp() - since < options_.motion.settle_s) return;
    landmark.motion.Restart();
    const auto recent = std::find_if(landmark.sightings.begin(), landmark.sightings.end(),
                                     [since](const Sighting& s) { return s.stamp >= since; });
    landmark.sightings.erase(landmark.sightings.begin(), recent);
    SetState(landmark.id, LandmarkState::kTentative);
  } else if (motion == Motion::kDriving) {
    SetState(landmark.id, LandmarkState::kDynamic);
    ++update.turned_dynamic;
  } else if (landmark.state == LandmarkState::kTentative && motion == Motion::kParked &&
             static_cast<int>(landmark.sightings.size()) >= options_.confirm_sightings) {
    SetState(landmark.id, LandmarkState::kConfirmed);
    ++update.confirmed;
  }
}

}  // namespace sslcd
