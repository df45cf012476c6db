// SPDX-License-Identifier: BSD-3-Clause
#include "closing/pass_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "closing/mean_place.h"

namespace sslcd {

void PassMap::Take(const FrameRecord& frame, int index, const std::vector<Detection>& seen,
                   const MapState& state) {
  for (std::size_t d = 0; d < frame.matched.size(); ++d) {
    const LandmarkId id = frame.matched[d];
    if (id.value < 0) continue;
    const auto known = open_.find(id.value);
    if (known == open_.end() || frame.travelled - passes_[known->second].last_m > split_m_) {
      if (known != open_.end()) Finish(state, passes_[known->second]);
      open_[id.value] = static_cast<int>(passes_.size());
      std::vector<int>& all = passes_of_[id.value];
      const LandmarkId own_id = all.empty() ? id : passes_[all.back()].own_id;
      all.push_back(static_cast<int>(passes_.size()));
      PassObject& fresh = passes_.emplace_back();
      fresh.id = id;
      fresh.own_id = own_id;
      fresh.first_m = frame.travelled;
      fresh.appearance = PerCue<Gallery>(Gallery(galleries_));
    }
    PassObject& pass = passes_[open_[id.value]];
    pass.last_m = frame.travelled;
    pass.sightings.push_back({index, static_cast<int>(d)});
    const Vec3 camera = seen[d].T_cam_object.inverse().translation();
    const double viewpoint = std::atan2(camera.y(), camera.x());
    for (const CueRow& row : kCueRows)
      pass.appearance[row.cue].Add(seen[d].appearance[row.cue], viewpoint);
  }
}

void PassMap::AddFrame(const MapState& state, const std::vector<Detection>& seen) {
  Take(state.frames.back(), state.frames.size() - 1, seen, state);
  FinishOld(state);
}

void PassMap::FinishOld(const MapState& state) {
  for (auto open = open_.begin(); open != open_.end();) {
    PassObject& pass = passes_[open->second];
    const bool over = state.frames.back().travelled - pass.last_m > split_m_;
    if (over) Finish(state, pass);
    open = over ? open_.erase(open) : std::next(open);
  }
}

void PassMap::Rebuild(const MapState& state) {
  const std::vector<PassObject> before = std::move(passes_);
  passes_.clear();
  passes_of_.clear();
  open_.clear();
  ++generation_;
  for (int f = 0; f < state.frames.size(); ++f)
    Take(state.frames[f], f, state.frames[f].detections, state);
  if (!state.frames.empty()) FinishOld(state);
  InheritFrom(before);
}

void PassMap::InheritFrom(const std::vector<PassObject>& before) {
  std::map<std::pair<int, int>, std::size_t> now;
  for (std::size_t i = 0; i < passes_.size(); ++i)
    for (const auto& sighting : passes_[i].sightings) now[sighting] = i;
  std::vector<std::map<int, int>> votes(passes_.size());  // sightings by own id
  for (const PassObject& old : before) {
    std::map<std::size_t, std::size_t> shares;
    const std::size_t half = (old.sightings.size() + 1) / 2;
    bool inherited = false;
    for (const auto& sighting : old.sightings) {
      const auto pass = now.find(sighting);
      if (pass == now.end()) continue;
      ++votes[pass->second][old.own_id.value];
      if (++shares[pass->second] != half || inherited) continue;
      inherited = true;
      for (const CueRow& row : kCueRows)
        passes_[pass->second].appearance[row.cue].Merge(old.appearance[row.cue]);
    }
  }
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    const auto most =
        std::max_element(votes[i].begin(), votes[i].end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most != votes[i].end()) passes_[i].own_id = {most->first};
  }
}

void PassMap::Finish(const MapState& state, PassObject& pass) {
  journal_.push_back(pass.id.value);
  pass.anchor = pass.sightings[pass.sightings.size() / 2].first;
  const auto place = MeanPlace(pass, state, noise_, {0., pass.last_m, 1});
  pass.T_anchor_object =
      state.frames[pass.anchor].T_world_cam.inverse() * ToPose(place->pose, state.gravity());
  pass.height_m = place->height_m;
}

void PassMap::Rename(const std::map<int, LandmarkId>& merged) {
  if (merged.empty()) return;
  for (const auto& [gone, first] : merged) {
    LandmarkId id = first;
    for (auto next = merged.find(id.value); next != merged.end(); next = merged.find(id.value))
      id = next->second;
    journal_.insert(journal_.end(), {gone, id.value});
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

int PassMap::LabelNumber(const std::string& label) const {
  return labels_.insert({label, static_cast<int>(labels_.size())}).first->second;
}

const std::vector<int>& PassMap::PassesOf(LandmarkId id) const {
  static const std::vector<int> kNone;
  const auto known = passes_of_.find(id.value);
  return known == passes_of_.end() ? kNone : known->second;
}

std::optional<std::pair<int, int>> PassMap::NearestSighting(const FrameStore& frames, LandmarkId id,
                                                            double path_m) const {
  std::optional<std::pair<int, int>> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const int i : PassesOf(id)) {
    for (const auto& sighting : passes_[i].sightings) {
      const double away = std::abs(frames[sighting.first].travelled - path_m);
      if (away >= least) continue;
      least = away;
      nearest = sighting;
    }
  }
  return nearest;
}

double PassMap::NearestPass(const FrameStore& frames, LandmarkId id, double path_m) const {
  double best = path_m, least = std::numeric_limits<double>::infinity();
  for (const int i : PassesOf(id)) {
    if (passes_[i].anchor < 0) continue;
    const double seen_m = frames[passes_[i].anchor].travelled;
    const double away = std::abs(seen_m - path_m);
    if (away >= least) continue;
    least = away;
    best = seen_m;
  }
  return best;
}

}  // namespace sslcd
