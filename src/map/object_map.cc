// SPDX-License-Identifier: BSD-3-Clause
#include "map/object_map.h"

#include <algorithm>
#include <cmath>

#include "map/noise_learning.h"
#include "perception/projection.h"

namespace sslcd {

struct ObjectMap::View {
  int frame;
  double stamp;
  double travelled;
  Pose T_world_cam;
  const Camera* camera;
};

namespace {

// Sightings of a landmark before its position is used to learn the noise. Set by hand.
constexpr int kLearnAfter = 3;

// Bearing of the camera in the object frame, which defines the visible side.
double Viewpoint(const Pose& T_cam_object) {
  const Vec3 camera_in_object = T_cam_object.inverse().translation();
  return std::atan2(camera_in_object.y(), camera_in_object.x());
}

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
      noise_scale_(NoiseScale::Uniform(noise.initial_scale)) {}

MapUpdate ObjectMap::AddFrame(int frame, double stamp, const Pose& T_world_cam,
                              const std::vector<Detection>& detections, const Camera* camera,
                              double travelled_m) {
  const View view{frame, stamp, travelled_m, T_world_cam, camera};
  for (const int id : open_) Reindex(landmarks_.at(id), stamp);

  const std::vector<AssociationQuery> queries = QueriesOf(detections, view);
  std::vector<int> ids;
  for (const int id : CandidateIds(queries))
    if (travelled_m - landmarks_.at(id).last_seen_at <= options_.memory_m) ids.push_back(id);
  const std::vector<int> match = MatchIds(queries, ids, view);

  MapUpdate update;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (match[i] >= 0) {
      MapLandmark& landmark = landmarks_.at(match[i]);
      Update(landmark, queries[i], view);
      Judge(landmark, update);
      update.matched.push_back(landmark.id);
    } else if (detections[i].score >= options_.birth_score) {
      Create(queries[i], view);
      ++update.born;
      update.matched.push_back({next_id_ - 1});
    } else {
      update.matched.push_back({});
    }
  }
  Retire(stamp);
  return update;
}

std::vector<LandmarkId> ObjectMap::Match(double stamp, const Pose& T_world_cam,
                                         const std::vector<Detection>& detections,
                                         const Camera* camera,
                                         const std::function<bool(const MapLandmark&)>& may) const {
  const View view{0, stamp, 0., T_world_cam, camera};
  const std::vector<AssociationQuery> queries = QueriesOf(detections, view);
  std::vector<int> ids;
  for (const int id : CandidateIds(queries))
    if (landmarks_.at(id).state == LandmarkState::kConfirmed && (!may || may(landmarks_.at(id))))
      ids.push_back(id);
  std::vector<LandmarkId> matched;
  for (const int id : MatchIds(queries, ids, view)) matched.push_back({id});
  return matched;
}

// The landmark of each query among `ids`; -1: none.
std::vector<int> ObjectMap::MatchIds(const std::vector<AssociationQuery>& queries,
                                     std::vector<int> ids, const View& view) const {
  std::vector<AssociationCandidate> candidates;
  for (const int id : ids) candidates.push_back(CandidateOf(landmarks_.at(id), view));
  std::vector<int> match = Associate(queries, candidates, association_);
  for (int& k : match) k = k >= 0 ? ids[k] : -1;
  return match;
}

std::vector<AssociationQuery> ObjectMap::QueriesOf(const std::vector<Detection>& detections,
                                                   const View& view) const {
  std::vector<AssociationQuery> queries;
  for (const Detection& detection : detections) queries.push_back(QueryOf(detection, view));
  return queries;
}

AssociationQuery ObjectMap::QueryOf(const Detection& detection, const View& view) const {
  AssociationQuery query;
  query.detection = &detection;
  const Vec3 point_cam = detection.T_cam_object.translation();
  const Vec3 point_world = view.T_world_cam * point_cam;
  query.place.position = Horizontal(point_world);
  query.height = point_world.dot(gravity_.up);
  NoiseScale cautious = noise_scale_;
  cautious.radial = std::hypot(kNoiseCaution * cautious.radial, kLongTailScale);
  cautious.lateral = std::hypot(kNoiseCaution * cautious.lateral, kLongTailScale);
  const DetectionSigmas sigmas = SigmasAt(point_cam.norm(), noise_, cautious);
  const Eigen::Matrix3d R = view.T_world_cam.so3().matrix();
  Eigen::Matrix<double, 2, 3> to_plane;
  to_plane << gravity_.forward.transpose(), gravity_.left.transpose();
  const Eigen::Matrix<double, 2, 3> J = to_plane * R;
  query.place.covariance = J * PositionCovariance(point_cam, sigmas) * J.transpose();
  query.viewpoint_rad = Viewpoint(detection.T_cam_object);
  return query;
}

AssociationCandidate ObjectMap::CandidateOf(const MapLandmark& landmark, const View& view) const {
  AssociationCandidate candidate;
  candidate.label = landmark.label;
  const auto parked = landmark.motion.PredictParked(view.stamp, options_.motion);
  const auto driving = landmark.motion.PredictDriving(view.stamp, options_.motion);
  const PlanarBelief parked_belief{Horizontal(landmark.pose.position), parked.covariance};
  const PlanarBelief driving_belief{driving.position, driving.covariance};
  Vec3 position = landmark.pose.position;
  if (landmark.state == LandmarkState::kDynamic) {
    candidate.beliefs = {driving_belief, parked_belief};
    const Vec2 moved = driving.position - Horizontal(position);
    position += moved.x() * gravity_.forward + moved.y() * gravity_.left;
  } else {
    candidate.beliefs = {parked_belief};
    if (Movable(landmark)) candidate.beliefs.push_back(driving_belief);
  }
  candidate.height = landmark.pose.position.dot(gravity_.up);
  const Pose T_cam_object =
      view.T_world_cam.inverse() * ToPose({position, landmark.pose.yaw}, gravity_);
  candidate.viewpoint_rad = Viewpoint(T_cam_object);
  if (view.camera != nullptr)
    candidate.projected_box = ProjectCuboid(T_cam_object, landmark.dims, *view.camera);
  candidate.appearance = &landmark.appearance;
  return candidate;
}

std::vector<int> ObjectMap::CandidateIds(const std::vector<AssociationQuery>& queries) const {
  std::vector<int> ids;
  for (const AssociationQuery& query : queries) {
    const auto near =
        index_.Near(query.place.position.x(), query.place.position.y(), options_.search_radius_m);
    ids.insert(ids.end(), near.begin(), near.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

void ObjectMap::Create(const AssociationQuery& query, const View& view) {
  MapLandmark landmark;
  landmark.label = query.detection->label;
  landmark.symmetry = labels_[landmark.label].symmetry;
  landmark.pose = ToUpright(view.T_world_cam * query.detection->T_cam_object, gravity_);
  const Gallery::Mode mode = association_.method == AssociationOptions::Method::kPaper
                                 ? Gallery::Mode::kMean
                                 : Gallery::Mode::kByViewpoint;
  landmark.appearance = PerCue<Gallery>(Gallery(mode));
  const LandmarkId id = Insert(std::move(landmark));
  Update(landmarks_.at(id.value), query, view);
}

LandmarkId ObjectMap::Insert(MapLandmark landmark) {
  landmark.id = {next_id_++};
  const LandmarkId id = landmark.id;
  const Vec2 place = Horizontal(landmark.pose.position);
  index_.Put(id.value, place.x(), place.y());
  if (landmark.state != LandmarkState::kConfirmed) open_.push_back(id.value);
  landmarks_.emplace(id.value, std::move(landmark));
  return id;
}

void ObjectMap::Update(MapLandmark& landmark, const AssociationQuery& query, const View& view) {
  const Detection& detection = *query.detection;
  if (options_.learn_noise && landmark.sightings.size() >= kLearnAfter &&
      landmark.state == LandmarkState::kConfirmed)
    LearnNoise(landmark, detection, view.T_world_cam, gravity_, noise_, noise_scale_);

  landmark.motion.Add(query.place.position, query.place.covariance, view.stamp, options_.motion);
  for (const CueRow& row : kCueRows)
    landmark.appearance[row.cue].Add(detection.appearance[row.cue], query.viewpoint_rad);
  landmark.sightings.push_back({view.frame, view.stamp, detection.row, detection.score,
                                detection.T_cam_object, detection.dims});
  landmark.last_seen = view.stamp;
  landmark.last_seen_at = view.travelled;

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
  Reindex(landmark, view.stamp);
}

void ObjectMap::Judge(MapLandmark& landmark, MapUpdate& update) {
  const Motion motion =
      Movable(landmark) ? landmark.motion.Verdict(options_.motion) : Motion::kParked;
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

void ObjectMap::Retire(double stamp) {
  std::vector<int> still_open;
  for (const int id : open_) {
    MapLandmark& landmark = landmarks_.at(id);
    if (stamp - landmark.last_seen <= options_.stale_after_s) {
      still_open.push_back(id);
      continue;
    }
    if (landmark.state == LandmarkState::kTentative) landmark.state = LandmarkState::kStale;
    index_.Remove(id);
  }
  open_ = std::move(still_open);
}

void ObjectMap::Reindex(const MapLandmark& landmark, double stamp) {
  const Vec2 place = landmark.state == LandmarkState::kDynamic
                         ? landmark.motion.PredictDriving(stamp, options_.motion).position
                         : Horizontal(landmark.pose.position);
  index_.Put(landmark.id.value, place.x(), place.y());
}

void ObjectMap::SetPose(LandmarkId id, const UprightPose& pose) {
  MapLandmark& landmark = landmarks_.at(id.value);
  landmark.motion.Shift(Horizontal(pose.position) - Horizontal(landmark.pose.position));
  landmark.pose = pose;
  Reindex(landmark, landmark.last_seen);
}

void ObjectMap::SetState(LandmarkId id, LandmarkState state) {
  MapLandmark& landmark = landmarks_.at(id.value);
  if (landmark.state == state) return;
  landmark.state = state;
  const auto place = std::find(open_.begin(), open_.end(), id.value);
  if (state == LandmarkState::kConfirmed) {
    if (place != open_.end()) open_.erase(place);
  } else if (place == open_.end()) {
    open_.push_back(id.value);
  }
}

void ObjectMap::SetSightings(LandmarkId id, std::vector<Sighting> sightings) {
  ++rewrites_;
  if (sightings.empty()) {
    index_.Remove(id.value);
    open_.erase(std::remove(open_.begin(), open_.end(), id.value), open_.end());
    landmarks_.erase(id.value);
    return;
  }
  MapLandmark& landmark = landmarks_.at(id.value);
  landmark.sightings = std::move(sightings);
  landmark.dims = FuseDims(landmark.sightings);
}

void ObjectMap::Fuse(LandmarkId keep, LandmarkId drop) {
  MapLandmark& kept = landmarks_.at(keep.value);
  const MapLandmark& dropped = landmarks_.at(drop.value);
  std::map<int, Sighting> by_frame;
  for (const Sighting& sighting : dropped.sightings) by_frame[sighting.frame] = sighting;
  for (const Sighting& sighting : kept.sightings) by_frame[sighting.frame] = sighting;
  std::vector<Sighting> merged;
  for (const auto& [frame, sighting] : by_frame) merged.push_back(sighting);
  for (const CueRow& row : kCueRows)
    kept.appearance[row.cue].Merge(dropped.appearance[row.cue], dropped.pose.yaw - kept.pose.yaw);
  kept.last_seen = std::max(kept.last_seen, dropped.last_seen);
  kept.last_seen_at = std::max(kept.last_seen_at, dropped.last_seen_at);
  SetSightings(drop, {});
  SetSightings(keep, std::move(merged));
}

std::vector<LandmarkId> ObjectMap::Near(const Vec3& point_world, double radius_m) const {
  const Vec2 place = Horizontal(point_world);
  std::vector<LandmarkId> ids;
  for (const int id : index_.Near(place.x(), place.y(), radius_m)) ids.push_back({id});
  return ids;
}

}  // namespace sslcd
