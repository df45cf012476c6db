// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_tracks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/math.h"
#include "sslcd/core/pose.h"

namespace sslcd {
namespace {

Vec3 CentreOf(const std::vector<LayoutObject>& local) {
  Vec3 centre = Vec3::Zero();
  for (const LayoutObject& object : local)
    centre += object.position / static_cast<double>(local.size());
  return centre;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, PoseTrackOptions& options) {
  visitor.Real("agree_m", options.agree_m, 0, 10000,
               "attempts farther back on the path than this do not count for a track");
}

void PoseTracks::Update(const LayoutLikelihood& likelihood,
                        const std::vector<PoseHypothesis>& found, const PoseSearchOptions& search,
                        double path_m, const Prior& prior) {
  const std::vector<LayoutObject>& local = likelihood.local();
  if (local.empty()) return;
  const Vec3 centre = CentreOf(local);
  const auto near = [&](const YawShift& a, const YawShift& b, double distance, double angle) {
    return (Apply(a, centre) - Apply(b, centre)).head<2>().norm() < distance &&
           std::abs(WrapAngle(a.yaw - b.yaw)) < angle;
  };
  std::vector<int> ids;
  for (const LayoutObject& object : local) ids.push_back(object.id);
  // Tracks that are as old have seen the same local maps: how many different objects these had is
  // counted once.
  std::map<std::pair<double, std::size_t>, double> different_since;
  const auto different = [&](const std::vector<PoseTrack::Vote>& votes) {
    const auto [known, fresh] = different_since.insert({{votes.front().path_m, votes.size()}, 0});
    if (fresh) {
      std::vector<int> all;
      for (const PoseTrack::Vote& vote : votes)
        all.insert(all.end(), vote.objects.begin(), vote.objects.end());
      std::sort(all.begin(), all.end());
      known->second = static_cast<double>(std::unique(all.begin(), all.end()) - all.begin());
    }
    return known->second;
  };
  std::vector<PoseTrack> now;
  const auto add = [&](PoseTrack track, const YawShift& pose, const LayoutFit& fit) {
    for (const PoseTrack& other : now)
      if (near(other.pose, pose, search.distinct_m, search.distinct_rad)) return;
    track.pose = pose;
    track.fit = fit;
    track.votes.push_back({path_m, fit.score, ids});
    while (path_m - track.votes.front().path_m > options_.agree_m)
      track.votes.erase(track.votes.begin());
    double scores = 0, objects = 0;
    for (const PoseTrack::Vote& vote : track.votes) {
      scores += vote.score;
      objects += static_cast<double>(vote.objects.size());
    }
    track.prior = prior(pose, fit);
    track.evidence =
        track.prior + fit.evidence - fit.score + scores * different(track.votes) / objects;
    now.push_back(std::move(track));
  };
  for (PoseTrack& track : tracks_) {
    YawShift pose = track.pose;
    LayoutFit fit = likelihood.Refine(pose, 4);
    if (!near(pose, track.pose, options_.step_m, options_.step_rad)) continue;
    if (static_cast<int>(fit.matches.size()) < search.min_matches) continue;
    add(std::move(track), pose, fit);
  }
  for (const PoseHypothesis& hypothesis : found) {
    PoseTrack track;
    track.id = next_id_++;
    add(std::move(track), hypothesis.pose, hypothesis.fit);
  }
  std::stable_sort(now.begin(), now.end(),
                   [](const PoseTrack& a, const PoseTrack& b) { return a.evidence > b.evidence; });
  if (static_cast<int>(now.size()) > options_.max_tracks) now.resize(options_.max_tracks);
  tracks_ = std::move(now);
}

double PoseTracks::Margin(std::size_t track) const {
  std::vector<double> rivals = {0.};  // "nowhere" has evidence 0
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (i != track) rivals.push_back(tracks_[i].evidence);
  return tracks_[track].evidence - LogSumExp(rivals);
}

void PoseTracks::Move(const YawShift& change) {
  for (PoseTrack& track : tracks_) {
    // pose o change^-1
    const YawShift before = track.pose;
    track.pose.yaw = WrapAngle(before.yaw - change.yaw);
    track.pose.t = Vec3::Zero();
    track.pose.t = before.t - Apply(track.pose, change.t);
  }
}

}  // namespace sslcd
