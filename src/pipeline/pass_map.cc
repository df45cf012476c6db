// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/pass_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sslcd {
namespace {

// Information-weighted mean of where the sightings on a stretch of the path put an object. None if
// they are fewer than asked for.
struct Place {
  UprightPose pose;
  double height_m = 0, seen_m = 0;
};
std::optional<Place> MeanPlace(const PassObject& pass, const std::vector<FrameRecord>& frames,
                               const GravityFrame& gravity, const DetectionNoise& noise,
                               double from_m, double to_m, int min_sightings) {
  const Vec3 up_in_cam = frames.front().T_world_cam.so3().inverse() * gravity.up;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Vec3 weighted = Vec3::Zero();
  std::vector<double> yaws;
  double path = 0;
  double nearest = std::numeric_limits<double>::infinity();
  Pose T_cam_world;  // of the nearest camera
  for (const auto& [f, d] : pass.sightings) {
    const FrameRecord& frame = frames[f];
    if (frame.travelled < from_m || frame.travelled > to_m) continue;
    const Pose& T_cam_object = frame.detections[d].T_cam_object;
    const Vec3 p = T_cam_object.translation();
    const Eigen::Matrix3d R = frame.T_world_cam.so3().matrix();
    const DetectionSigmas sigmas = SigmasAt(p.norm(), noise, {});
    const Eigen::Matrix3d I = R * PositionCovariance(p, sigmas).inverse() * R.transpose();
    information += I;
    path += frame.travelled;
    if (p.norm() < nearest) {
      nearest = p.norm();
      T_cam_world = frame.T_world_cam.inverse();
    }
    weighted += I * (frame.T_world_cam * p);
    yaws.push_back(gravity.YawOf((frame.T_world_cam * T_cam_object).so3()));
  }
  if (static_cast<int>(yaws.size()) < std::max(1, min_sightings)) return std::nullopt;
  Vec2 axis(0, 0);  // of doubled angles: a heading may be turned round by mistake
  for (const double yaw : yaws) axis += Vec2(std::cos(2 * yaw), std::sin(2 * yaw));
  const Vec3 position = information.ldlt().solve(weighted);
  return Place{{position, VoteHeading(0.5 * std::atan2(axis.y(), axis.x()), yaws)},
               (T_cam_world * position).dot(up_in_cam),
               path / static_cast<double>(yaws.size())};
}

bool Usable(const ObjectMap& map, LandmarkId id) {
  const auto landmark = map.landmarks().find(id.value);
  return landmark != map.landmarks().end() && landmark->second.state == LandmarkState::kConfirmed;
}

}  // namespace

void PassMap::Update() {
  moved_from_ = std::min(moved_from_, next_frame_);
  for (; next_frame_ < frames_.size(); ++next_frame_) {
    const FrameRecord& frame = frames_[next_frame_];
    for (std::size_t d = 0; d < frame.matched.size(); ++d) {
      const LandmarkId id = frame.matched[d];
      if (id.value < 0) continue;
      const auto known = open_.find(id.value);
      if (known == open_.end() || frame.travelled - passes_[known->second].last_m > split_m_) {
        if (known != open_.end()) Finish(passes_[known->second]);
        open_[id.value] = static_cast<int>(passes_.size());
        passes_of_[id.value].push_back(static_cast<int>(passes_.size()));
        passes_.push_back({id,
                           frame.travelled,
                           frame.travelled,
                           {},
                           -1,
                           {},
                           0,
                           Gallery(galleries_),
                           Gallery(galleries_)});
      }
      PassObject& pass = passes_[open_[id.value]];
      pass.last_m = frame.travelled;
      pass.sightings.push_back({static_cast<int>(next_frame_), static_cast<int>(d)});
      const Detection& detection = frame.detections[d];
      const Vec3 camera = detection.T_cam_object.inverse().translation();
      const double viewpoint = std::atan2(camera.y(), camera.x());
      pass.colour.Add(detection.colour, viewpoint);
      pass.embedding.Add(detection.embedding, viewpoint);
    }
  }
  for (auto open = open_.begin(); open != open_.end();) {
    PassObject& pass = passes_[open->second];
    const bool over = frames_.back().travelled - pass.last_m > split_m_;
    if (over) Finish(pass);
    open = over ? open_.erase(open) : std::next(open);
  }
}

void PassMap::Rebuild() {
  const std::vector<PassObject> before = std::move(passes_);
  passes_.clear();
  passes_of_.clear();
  open_.clear();
  next_frame_ = moved_from_ = 0;
  if (!frames_.empty()) Update();
  std::map<std::pair<int, int>, std::size_t> now;
  for (std::size_t i = 0; i < passes_.size(); ++i)
    for (const auto& sighting : passes_[i].sightings) now[sighting] = i;
  for (const PassObject& old : before) {
    std::map<std::size_t, std::size_t> shares;
    for (const auto& sighting : old.sightings) {
      const auto pass = now.find(sighting);
      if (pass == now.end() ||
          2 * ++shares[pass->second] != old.sightings.size() + old.sightings.size() % 2)
        continue;
      passes_[pass->second].colour.Merge(old.colour);
      passes_[pass->second].embedding.Merge(old.embedding);
      break;
    }
  }
}

void PassMap::Finish(PassObject& pass) {
  touched_.insert(pass.id.value);
  pass.anchor = pass.sightings[pass.sightings.size() / 2].first;
  const auto place = MeanPlace(pass, frames_, map_.gravity(), noise_, 0., pass.last_m, 1);
  pass.T_anchor_object =
      frames_[pass.anchor].T_world_cam.inverse() * ToPose(place->pose, map_.gravity());
  pass.height_m = place->height_m;
}

void PassMap::Rename(const std::map<int, LandmarkId>& heirs) {
  for (const auto& [gone, first] : heirs) {
    LandmarkId id = first;
    for (auto heir = heirs.find(id.value); heir != heirs.end(); heir = heirs.find(id.value))
      id = heir->second;
    touched_.insert({gone, id.value});
    const auto known = passes_of_.find(gone);
    if (known == passes_of_.end()) continue;
    for (const int pass : known->second) passes_[pass].id = id;
    std::vector<int>& all = passes_of_[id.value];
    all.insert(all.end(), known->second.begin(), known->second.end());
    std::sort(all.begin(), all.end());
    passes_of_.erase(known);
  }
  std::map<int, int> open;
  for (const auto& [id, index] : open_) {
    const auto [other, is_new] = open.insert({passes_[index].id.value, index});
    if (!is_new) other->second = std::max(other->second, index);
  }
  open_ = std::move(open);
}

void PassMap::Append(LandmarkId id, const UprightPose& place, double height_m, double seen_m,
                     const Gallery& colour, const Gallery& embedding, PassLayout& layout) const {
  const MapLandmark& landmark = map_.at(id);
  LayoutObject object;
  object.id = id.value;
  object.label = labels_.insert({landmark.label, static_cast<int>(labels_.size())}).first->second;
  object.symmetry = landmark.symmetry;
  object.position = map_.gravity().Basis().transpose() * place.position;
  object.position.z() = height_m;
  object.yaw =
      landmark.symmetry == Symmetry::kFull ? std::numeric_limits<double>::quiet_NaN() : place.yaw;
  object.dims = landmark.dims;
  object.colour = colour.Views();
  object.embedding = embedding.Views();
  if (!object.position.allFinite()) return;
  layout.objects.push_back(std::move(object));
  layout.places.push_back(place);
  layout.seen_m.push_back(seen_m);
}

PassLayout PassMap::Between(double from_m, double to_m, int min_sightings) const {
  std::set<int> ids;
  for (std::size_t f = FrameFrom(from_m); f < frames_.size() && frames_[f].travelled <= to_m; ++f)
    SeenIn(f, f + 1, ids);
  PassLayout layout;
  for (const int id : ids) {
    if (!Usable(map_, {id})) continue;
    const std::vector<int>& all = PassesOf({id});
    const auto latest = std::find_if(all.rbegin(), all.rend(), [&](int pass) {
      return passes_[pass].last_m >= from_m && passes_[pass].first_m <= to_m;
    });
    if (latest == all.rend()) continue;
    const PassObject& pass = passes_[*latest];
    const auto place =
        MeanPlace(pass, frames_, map_.gravity(), noise_, from_m, to_m, min_sightings);
    if (place)
      Append({id}, place->pose, place->height_m, place->seen_m, pass.colour, pass.embedding,
             layout);
  }
  return layout;
}

std::size_t PassMap::FrameFrom(double path_m) const {
  const auto at =
      std::lower_bound(frames_.begin(), frames_.end(), path_m,
                       [](const FrameRecord& frame, double m) { return frame.travelled < m; });
  return static_cast<std::size_t>(at - frames_.begin());
}

void PassMap::SeenIn(std::size_t from, std::size_t to, std::set<int>& ids) const {
  for (std::size_t f = from; f < to; ++f)
    for (const LandmarkId id : frames_[f].matched)
      if (id.value >= 0) ids.insert(id.value);
}

struct PassMap::Sum {
  Vec3 position{0, 0, 0};
  double weight = 0, yaw = 0, height = 0, seen_m = 0;
  std::vector<const PassObject*> passes;
};

std::optional<PassMap::Sum> PassMap::SumBefore(int id, double to_m, int min_sightings) const {
  if (!Usable(map_, {id})) return std::nullopt;
  Sum sum;
  for (const int i : PassesOf({id})) {
    const PassObject& pass = passes_[i];
    if (pass.anchor < 0 || pass.last_m >= to_m ||
        static_cast<int>(pass.sightings.size()) < min_sightings)
      continue;
    const UprightPose place =
        ToUpright(frames_[pass.anchor].T_world_cam * pass.T_anchor_object, map_.gravity());
    const double weight = static_cast<double>(pass.sightings.size());
    sum.position += weight * place.position;
    sum.height += weight * pass.height_m;
    sum.weight += weight;
    sum.yaw = place.yaw;
    sum.seen_m = frames_[pass.anchor].travelled;
    sum.passes.push_back(&pass);
  }
  if (sum.passes.empty()) return std::nullopt;
  return sum;
}

void PassMap::AppendBefore(int id, double to_m, int min_sightings, PassLayout& layout) const {
  const auto sum = SumBefore(id, to_m, min_sightings);
  if (!sum) return;
  Gallery colour(galleries_), embedding(galleries_);
  for (const PassObject* pass : sum->passes) {
    colour.Merge(pass->colour);
    embedding.Merge(pass->embedding);
  }
  Append({id}, {sum->position / sum->weight, sum->yaw}, sum->height / sum->weight, sum->seen_m,
         colour, embedding, layout);
}

PassLayout PassMap::Before(double to_m, int min_sightings) const {
  PassLayout layout;
  for (const auto& [id, passes] : passes_of_) AppendBefore(id, to_m, min_sightings, layout);
  return layout;
}

LayoutChanges PassMap::ChangesBefore(double to_m, int min_sightings) {
  LayoutChanges changes;
  changes.anew =
      moved_from_ == 0 || to_m < changes_to_m_ || min_sightings != changes_min_sightings_;
  if (changes.anew) {
    changes.objects = Before(to_m, min_sightings).objects;
  } else {
    // A pass that moves with its anchor, or has just become old, was seen by the frame in question.
    SeenIn(moved_from_, frames_.size(), touched_);
    SeenIn(FrameFrom(changes_to_m_), FrameFrom(to_m), touched_);
    PassLayout layout;
    for (const int id : touched_) {
      const std::size_t before = layout.objects.size();
      AppendBefore(id, to_m, min_sightings, layout);
      if (layout.objects.size() == before) changes.gone.push_back(id);
    }
    changes.objects = std::move(layout.objects);
  }
  changes_to_m_ = to_m;
  changes_min_sightings_ = min_sightings;
  moved_from_ = frames_.size();
  touched_.clear();
  return changes;
}

std::optional<UprightPose> PassMap::PlaceBefore(LandmarkId id, double to_m,
                                                int min_sightings) const {
  const auto sum = SumBefore(id.value, to_m, min_sightings);
  if (!sum) return std::nullopt;
  return UprightPose{sum->position / sum->weight, sum->yaw};
}

const std::vector<int>& PassMap::PassesOf(LandmarkId id) const {
  static const std::vector<int> kNone;
  const auto known = passes_of_.find(id.value);
  return known == passes_of_.end() ? kNone : known->second;
}

double PassMap::NearestPass(LandmarkId id, double path_m) const {
  double best = path_m, least = std::numeric_limits<double>::infinity();
  for (const int i : PassesOf(id)) {
    if (passes_[i].anchor < 0) continue;
    const double seen_m = frames_[passes_[i].anchor].travelled, away = std::abs(seen_m - path_m);
    if (away < least) least = away, best = seen_m;
  }
  return best;
}

}  // namespace sslcd
