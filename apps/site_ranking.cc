// SPDX-License-Identifier: BSD-3-Clause
#include "site_ranking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::apps {
namespace {

constexpr double kStretch = 100;  // of path, as SiteIndex::Find expects [m]

// The number of the stretch that each frame is in. Where the odometry jumps, one stretch ends and
// the next one begins: their number is at most that of the frames.
std::map<int, int> StretchesOf(const std::vector<Frame>& frames) {
  std::map<int, int> stretch;
  double path_m = 0;  // of the present stretch
  int number = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i > 0)
      path_m +=
          (frames[i].T_odom_cam.translation() - frames[i - 1].T_odom_cam.translation()).norm();
    if (!(path_m < kStretch)) {
      path_m = std::fmod(path_m, kStretch);
      ++number;
    }
    stretch[frames[i].index] = number;
  }
  return stretch;
}

// The confirmed landmarks that are seen in each stretch.
std::vector<std::vector<MapObject>> LandmarksOf(const Dataset& dataset,
                                                const std::vector<Frame>& frames) {
  Options options = DefaultOptions(Mode::kRobust);
  options.loop.enabled = false;
  Mapper mapper(options, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera});
  for (const Frame& frame : frames) mapper.AddFrame(frame);
  const std::map<int, int> stretch_of = StretchesOf(frames);
  std::vector<std::vector<MapObject>> stretches(
      static_cast<std::size_t>(stretch_of.rbegin()->second) + 1);
  for (const MapObject& object : mapper.Objects()) {
    std::set<int> seen_in;
    for (const Observation& seen : object.observations) seen_in.insert(stretch_of.at(seen.frame));
    for (const int stretch : seen_in) stretches[stretch].push_back(object);
  }
  return stretches;
}

}  // namespace

std::vector<RankedSite> RankSites(const SiteIndex& index, const Dataset& dataset,
                                  const std::vector<Frame>& frames, int most) {
  const GravityFrame gravity = GravityFrame::FromUp(dataset.up_axis);
  std::map<int, RankedSite> sites;
  for (const std::vector<MapObject>& landmarks : LandmarksOf(dataset, frames))
    for (const SiteCandidate& one : index.Find(SiteObjectsOf(landmarks, gravity), most)) {
      RankedSite& site = sites[one.site];
      if (site.stretches++ == 0 || one.score > site.best.score) site.best = one;
      site.score += one.score;
    }
  std::vector<RankedSite> ranked;
  for (auto& [number, site] : sites) ranked.push_back(std::move(site));
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const RankedSite& a, const RankedSite& b) { return a.score > b.score; });
  ranked.resize(std::min(ranked.size(), static_cast<std::size_t>(most)));
  return ranked;
}

}  // namespace sslcd::apps
