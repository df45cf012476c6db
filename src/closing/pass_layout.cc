// SPDX-License-Identifier: BSD-3-Clause
// The layouts of passes.
#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "closing/mean_place.h"
#include "closing/pass_map.h"

namespace sslcd {
namespace {

bool Usable(const ObjectMap& map, LandmarkId id) {
  const auto landmark = map.landmarks().find(id.value);
  return landmark != map.landmarks().end() && landmark->second.state == LandmarkState::kConfirmed;
}

void AddSeenIn(const FrameStore& frames, int from, int to, std::set<int>& ids) {
  for (int f = from; f < to; ++f)
    for (const LandmarkId id : frames[f].matched)
      if (id.value >= 0) ids.insert(id.value);
}

LayoutObject ObjectOf(const MapLandmark& landmark, const GravityFrame& gravity,
                      const MeanSighting& place) {
  LayoutObject object;
  object.id = landmark.id.value;
  object.symmetry = landmark.symmetry;
  object.position = gravity.Basis().transpose() * place.pose.position;
  object.position.z() = place.height_m;
  object.yaw = landmark.symmetry == Symmetry::kFull ? std::numeric_limits<double>::quiet_NaN()
                                                    : place.pose.yaw;
  object.dims = landmark.dims;
  return object;
}

}  // namespace

int PassMap::LabelNumber(const std::string& label) const {
  return labels_.insert({label, static_cast<int>(labels_.size())}).first->second;
}

PassLayout PassMap::Between(const MapState& state, double from_m, double to_m,
                            int min_sightings) const {
  std::set<int> ids;
  for (int f = state.frames.FirstFrom(from_m);
       f < state.frames.size() && state.frames[f].travelled <= to_m; ++f)
    AddSeenIn(state.frames, f, f + 1, ids);
  PassLayout layout;
  for (const int id : ids) {
    if (!Usable(state.map, {id})) continue;
    const std::vector<int>& all = PassesOf({id});
    const auto latest = std::find_if(all.rbegin(), all.rend(), [&](int pass) {
      return passes_[pass].last_m >= from_m && passes_[pass].first_m <= to_m;
    });
    if (latest == all.rend()) continue;
    const PassObject& pass = passes_[*latest];
    const auto place = MeanPlace(pass, state, noise_, {from_m, to_m, min_sightings});
    if (place) Append(state, {id}, *place, pass.appearance, layout);
  }
  return layout;
}

void PassMap::Append(const MapState& state, LandmarkId id, const MeanSighting& place,
                     const PerCue<Gallery>& appearance, PassLayout& layout) const {
  const MapLandmark& landmark = state.map.at(id);
  LayoutObject object = ObjectOf(landmark, state.gravity(), place);
  object.label = LabelNumber(landmark.label);
  for (const CueRow& row : kCueRows) object.appearance[row.cue] = appearance[row.cue].Views();
  if (!object.position.allFinite()) return;
  layout.objects.push_back(std::move(object));
  layout.places.push_back(place.pose);
  layout.seen_m.push_back(place.seen_m);
}

struct PassMap::Sum {
  Vec3 position{0, 0, 0};
  double weight = 0, yaw = 0, height = 0, seen_m = 0;
  std::vector<const PassObject*> passes;

  MeanSighting Mean() const { return {{position / weight, yaw}, height / weight, seen_m}; }
};

std::optional<PassMap::Sum> PassMap::SumBefore(const MapState& state, int id, double to_m,
                                               int min_sightings) const {
  if (!Usable(state.map, {id})) return std::nullopt;
  Sum sum;
  for (const int i : PassesOf({id})) {
    const PassObject& pass = passes_[i];
    if (pass.anchor < 0 || pass.last_m >= to_m ||
        static_cast<int>(pass.sightings.size()) < min_sightings)
      continue;
    const FrameRecord& anchor = state.frames[pass.anchor];
    const UprightPose place = ToUpright(anchor.T_world_cam * pass.T_anchor_object, state.gravity());
    const double weight = static_cast<double>(pass.sightings.size());
    sum.position += weight * place.position;
    sum.height += weight * pass.height_m;
    sum.weight += weight;
    sum.yaw = place.yaw;
    sum.seen_m = anchor.travelled;
    sum.passes.push_back(&pass);
  }
  if (sum.passes.empty()) return std::nullopt;
  return sum;
}

void PassMap::AppendBefore(const MapState& state, int id, double to_m, int min_sightings,
                           PassLayout& layout) const {
  const auto sum = SumBefore(state, id, to_m, min_sightings);
  if (!sum) return;
  PerCue<Gallery> appearance{Gallery(galleries_)};
  for (const PassObject* pass : sum->passes)
    for (const CueRow& row : kCueRows) appearance[row.cue].Merge(pass->appearance[row.cue]);
  Append(state, {id}, sum->Mean(), appearance, layout);
}

PassLayout PassMap::Before(const MapState& state, double to_m, int min_sightings) const {
  PassLayout layout;
  for (const auto& [id, passes] : passes_of_) AppendBefore(state, id, to_m, min_sightings, layout);
  return layout;
}

LayoutChanges PassMap::ChangesBefore(const MapState& state, double to_m, int min_sightings,
                                     Mark& mark) const {
  const FrameStore& frames = state.frames;
  const int first_change = frames.FirstChangeSince(mark.revision);
  LayoutChanges changes;
  changes.all = mark.generation != generation_ || first_change == 0 || to_m < mark.to_m;
  if (changes.all) {
    changes.objects = Before(state, to_m, min_sightings).objects;
  } else {
    // Changed passes were seen by one of these frames: those that moved with their anchor and those
    // that became old.
    std::set<int> touched(journal_.begin() + static_cast<std::ptrdiff_t>(mark.journal),
                          journal_.end());
    AddSeenIn(frames, first_change, frames.size(), touched);
    AddSeenIn(frames, frames.FirstFrom(mark.to_m), frames.FirstFrom(to_m), touched);
    PassLayout layout;
    for (const int id : touched) {
      const std::size_t before = layout.objects.size();
      AppendBefore(state, id, to_m, min_sightings, layout);
      if (layout.objects.size() == before) changes.gone.push_back(id);
    }
    changes.objects = std::move(layout.objects);
  }
  mark = {generation_, frames.revision(), journal_.size(), to_m};
  return changes;
}

std::optional<UprightPose> PassMap::PlaceBefore(const MapState& state, LandmarkId id, double to_m,
                                                int min_sightings) const {
  const auto sum = SumBefore(state, id.value, to_m, min_sightings);
  if (!sum) return std::nullopt;
  return sum->Mean().pose;
}

}  // namespace sslcd
