// SPDX-License-Identifier: BSD-3-Clause
#include "refine/fuse.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "refine/path_segments.h"

namespace sslcd {
namespace {

// Fuses the sightings of a landmark to its pose in the world.
struct Information {
  Eigen::Matrix3d position = Eigen::Matrix3d::Zero();
  double yaw = 0;
  int sightings = 0;
};

class Fusion {
 public:
  Fusion(MapState& state, const WholeMapOptions& options) : map_(state.map), options_(options) {
    for (const FrameRecord& record : state.frames)
      rotation_of_frame_[record.frame] = record.T_world_cam.so3().matrix();
  }

  const MergedIds& merged() const { return merged_; }

  void Fuse(LandmarkId keep, LandmarkId drop) {
    const MapLandmark &kept = map_.at(keep), &dropped = map_.at(drop);
    const NoiseScale& scale = map_.noise_scale();
    const Information a = InformationOf(kept, scale), b = InformationOf(dropped, scale);
    UprightPose pose = kept.pose;
    const Eigen::LDLT<Eigen::Matrix3d> both(a.position + b.position);
    const Vec3 step = both.solve(b.position * (dropped.pose.position - kept.pose.position));
    if (step.allFinite()) pose.position += step;
    // Front and back may be confused; a vote decides later.
    if (a.yaw + b.yaw > 0)
      pose.yaw = WrapAngle(pose.yaw +
                           b.yaw / (a.yaw + b.yaw) * WrapAngle(dropped.pose.yaw - pose.yaw, M_PI));
    map_.Fuse(keep, drop);
    map_.SetPose(keep, pose);
    merged_[drop.value] = keep;
  }

  // Whether the detector's errors explain the distance. They rotate with the viewing ray and
  // correlate from frame to frame, so a mean over sightings has the error of a single one.
  bool InOnePlace(const MapLandmark& a, const MapLandmark& b) const {
    constexpr double kChiSquare99 = 11.34;  // 3 degrees of freedom
    constexpr double kInside = 0.25;        // share of both sizes: half of a mean size. Set by hand
    const Vec3 d = map_.gravity().Basis().transpose() * (a.pose.position - b.pose.position);
    const double apart = d.head<2>().norm();
    if (!(apart <= options_.refine.duplicate_m)) return false;
    const double width = kInside * (a.dims.head<2>().minCoeff() + b.dims.head<2>().minCoeff());
    const double height = kInside * (a.dims.z() + b.dims.z());
    if (apart < width && std::abs(d.z()) < height) return true;  // the objects would overlap
    const Eigen::Matrix3d covariance = OneSighting(a) + OneSighting(b);
    return d.dot(covariance.ldlt().solve(d)) <= kChiSquare99;
  }

 private:
  Information InformationOf(const MapLandmark& landmark, const NoiseScale& scale) const {
    Information sum;
    for (const Sighting& sighting : landmark.sightings) {
      const auto R = rotation_of_frame_.find(sighting.frame);
      if (R == rotation_of_frame_.end()) continue;
      const Vec3& seen = sighting.T_cam_object.translation();
      const DetectionSigmas sigmas = SigmasAt(seen.norm(), options_.noise, scale);
      sum.position += R->second * PositionInformation(seen, sigmas) * R->second.transpose();
      sum.yaw += landmark.symmetry == Symmetry::kFull ? 0. : 1 / (sigmas.yaw * sigmas.yaw);
      ++sum.sightings;
    }
    return sum;
  }

  // Covariance of a typical sighting [forward, left, up], with the safety factor of association;
  // NaN without sightings.
  Eigen::Matrix3d OneSighting(const MapLandmark& landmark) const {
    NoiseScale scale = map_.noise_scale();
    for (double* component : {&scale.radial, &scale.lateral, &scale.vertical})
      *component = std::hypot(kNoiseCaution * *component, kLongTailScale);
    const Information sum = InformationOf(landmark, scale);
    const Eigen::Matrix3d basis = map_.gravity().Basis();
    return basis.transpose() * (sum.position / sum.sightings).inverse() * basis;
  }

  ObjectMap& map_;
  const WholeMapOptions& options_;
  std::map<int, Eigen::Matrix3d> rotation_of_frame_;
  MergedIds merged_;
};

// Whether `a` keeps its id when both are fused.
bool KeepsItsName(const MapLandmark& a, const MapLandmark& b) {
  const bool a_confirmed = a.state == LandmarkState::kConfirmed;
  const bool b_confirmed = b.state == LandmarkState::kConfirmed;
  return a_confirmed != b_confirmed ? a_confirmed : a.sightings.size() >= b.sightings.size();
}

// Replaces merged ids in the matches of the frames.
void RenameMatches(FrameStore& frames, const MergedIds& merged) {
  for (int i = 0; i < frames.size(); ++i) {
    std::vector<LandmarkId> matched = frames[i].matched;
    for (LandmarkId& id : matched) id = Resolve(id, merged);
    if (matched != frames[i].matched) frames.SetMatched(i, std::move(matched));
  }
}

}  // namespace

LandmarkId Resolve(LandmarkId id, const MergedIds& merged) {
  for (auto next = merged.find(id.value); next != merged.end(); next = merged.find(id.value))
    id = next->second;
  return id;
}

bool SeenTogether(const MapLandmark& a, const MapLandmark& b) {
  // Share of the smaller number of sightings, since a detector sometimes makes two boxes of one
  // object. Set by hand.
  constexpr double kSlip = 0.1;
  std::size_t together = 0;
  for (auto i = a.sightings.begin(), j = b.sightings.begin();
       i != a.sightings.end() && j != b.sightings.end();) {
    together += i->frame == j->frame ? 1 : 0;
    i->frame < j->frame ? ++i : ++j;
  }
  return together > kSlip * std::min(a.sightings.size(), b.sightings.size());
}

MergedIds FuseMatched(MapState& state, const std::vector<std::pair<LandmarkId, LandmarkId>>& pairs,
                      const WholeMapOptions& options) {
  Fusion fusion(state, options);
  const auto& all = state.map.landmarks();
  for (const auto& [first, second] : pairs) {
    const auto a = all.find(Resolve(first, fusion.merged()).value);
    const auto b = all.find(Resolve(second, fusion.merged()).value);
    if (a == all.end() || b == all.end() || a == b) continue;
    const MapLandmark &one = a->second, &other = b->second;
    const bool drives =
        one.state == LandmarkState::kDynamic || other.state == LandmarkState::kDynamic;
    if (drives || one.label != other.label || SeenTogether(one, other)) continue;
    KeepsItsName(one, other) ? fusion.Fuse(one.id, other.id) : fusion.Fuse(other.id, one.id);
  }
  RenameMatches(state.frames, fusion.merged());
  MergedIds merged = fusion.merged();
  merged.merge(FuseDuplicates(state, options));
  return merged;
}

MergedIds FuseDuplicates(MapState& state, const WholeMapOptions& options) {
  const ObjectMap& map = state.map;
  std::vector<LandmarkId> order;
  for (const auto& [id, landmark] : map.landmarks())
    if (landmark.state == LandmarkState::kConfirmed) order.push_back({id});
  std::stable_sort(order.begin(), order.end(), [&](LandmarkId a, LandmarkId b) {
    return map.at(a).sightings.size() > map.at(b).sightings.size();
  });
  PathSegments segments(state, options.map.memory_m);
  Fusion fusion(state, options);
  for (const LandmarkId keep : order) {
    if (map.landmarks().count(keep.value) == 0) continue;
    for (const LandmarkId other :
         map.FindWithin(map.at(keep).pose.position, options.refine.duplicate_m)) {
      const MapLandmark &one = map.at(keep), &twin = map.at(other);
      if (other == keep || twin.state != LandmarkState::kConfirmed || twin.label != one.label)
        continue;
      if (twin.sightings.size() > one.sightings.size() || !fusion.InOnePlace(one, twin)) continue;
      if (SeenTogether(one, twin) || !segments.Covisible(keep, other)) continue;
      fusion.Fuse(keep, other);
      segments.Fuse(keep, other);
    }
  }
  RenameMatches(state.frames, fusion.merged());
  return fusion.merged();
}

}  // namespace sslcd
