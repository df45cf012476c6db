// SPDX-License-Identifier: BSD-3-Clause
#include "closing/pass_layout.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

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
  object.altitude = object.position.z();
  object.position.z() = place.height_m;
  object.yaw = landmark.symmetry == Symmetry::kFull ? std::numeric_limits<double>::quiet_NaN()
                                                    : place.pose.yaw;
  object.dims = landmark.dims;
  return object;
}

}  // namespace

PassLayout PassLayouts::Between(double from_m, double to_m, int min_sightings) const {
  std::set<int> ids;
  for (int f = state_.frames.FirstFrom(from_m);
       f < state_.frames.size() && state_.frames[f].travelled <= to_m; ++f)
    AddSeenIn(state_.frames, f, f + 1, ids);
  PassLayout layout;
  for (const int id : ids) {
    if (!Usable(state_.map, {id})) continue;
    const std::vector<int>& all = passes_.PassesOf({id});
    const auto latest = std::find_if(all.rbegin(), all.rend(), [&](int pass) {
      return passes_.passes()[pass].last_m >= from_m && passes_.passes()[pass].first_m <= to_m;
    });
    if (latest == all.rend()) continue;
    const PassObject& pass = passes_.passes()[*latest];
    const auto place = MeanPlace(pass, state_, passes_.noise(), {from_m, to_m, min_sightings});
    if (place) Append({id}, *place, pass.appearance, layout);
  }
  return layout;
}

void PassLayouts::Append(LandmarkId id, const MeanSighting& place,
                         const PerCue<Gallery>& appearance, PassLayout& layout) const {
  const MapLandmark& landmark = state_.map.at(id);
  LayoutObject object = ObjectOf(landmark, state_.gravity(), place);
  object.label = passes_.LabelNumber(landmark.label);
  for (const CueRow& row : kCueRows) object.appearance[row.cue] = appearance[row.cue].Views();
  if (!object.position.allFinite()) return;
  layout.objects.push_back(std::move(object));
  layout.places.push_back(place.pose);
  layout.seen_m.push_back(place.seen_m);
}

struct PassLayouts::Sum {
  Vec3 position{0, 0, 0};
  double weight = 0, yaw = 0, height = 0, seen_m = 0;
  std::vector<const PassObject*> passes;

  MeanSighting Mean() const { return {{position / weight, yaw}, height / weight, seen_m}; }
};

std::optional<PassLayouts::Sum> PassLayouts::SumBefore(int id, double to_m,
                                                       int min_sightings) const {
  if (!Usable(state_.map, {id})) return std::nullopt;
  Sum sum;
  for (const int i : passes_.PassesOf({id})) {
    const PassObject& pass = passes_.passes()[i];
    if (pass.anchor < 0 || pass.last_m >= to_m ||
        static_cast<int>(pass.sightings.size()) < min_sightings)
      continue;
    const FrameRecord& anchor = state_.frames[pass.anchor];
    const UprightPose place =
        ToUpright(anchor.T_world_cam * pass.T_anchor_object, state_.gravity());
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

void PassLayouts::AppendBefore(int id, double to_m, int min_sightings, PassLayout& layout) const {
  const auto sum = SumBefore(id, to_m, min_sightings);
  if (!sum) return;
  PerCue<Gallery> appearance{Gallery(passes_.galleries())};
  for (const PassObject* pass : sum->passes)
    for (const CueRow& row : kCueRows) appearance[row.cue].Merge(pass->appearance[row.cue]);
  const std::size_t before = layout.objects.size();
  Append({id}, sum->Mean(), appearance, layout);
  if (layout.objects.size() > before) layout.objects.back().since_m = sum->passes.front()->last_m;
}

PassLayout PassLayouts::Before(double to_m, int min_sightings) const {
  PassLayout layout;
  for (const auto& [id, passes] : passes_.passes_of())
    AppendBefore(id, to_m, min_sightings, layout);
  return layout;
}

LayoutChanges PassLayouts::ChangesBefore(double to_m, int min_sightings, Mark& mark) const {
  const FrameStore& frames = state_.frames;
  const int first_change = frames.FirstChangeSince(mark.revision);
  LayoutChanges changes;
  changes.all = mark.generation != passes_.generation() || first_change == 0 || to_m < mark.to_m;
  if (changes.all) {
    changes.objects = Before(to_m, min_sightings).objects;
  } else {
    // Changed passes were seen by one of these frames: those that moved with their anchor and those
    // that became old.
    std::set<int> touched(passes_.journal().begin() + static_cast<std::ptrdiff_t>(mark.journal),
                          passes_.journal().end());
    AddSeenIn(frames, first_change, frames.size(), touched);
    AddSeenIn(frames, frames.FirstFrom(mark.to_m), frames.FirstFrom(to_m), touched);
    PassLayout layout;
    for (const int id : touched) {
      const std::size_t before = layout.objects.size();
      AppendBefore(id, to_m, min_sightings, layout);
      if (layout.objects.size() == before) changes.gone.push_back(id);
    }
    changes.objects = std::move(layout.objects);
  }
  mark = {passes_.generation(), frames.revision(), passes_.journal().size(), to_m};
  return changes;
}

std::optional<UprightPose> PassLayouts::PlaceBefore(LandmarkId id, double to_m,
                                                    int min_sightings) const {
  const auto sum = SumBefore(id.value, to_m, min_sightings);
  if (!sum) return std::nullopt;
  return sum->Mean().pose;
}

}  // namespace sslcd
