// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

// Whether two poses map a point to nearly the same place with nearly the same yaw.
bool AreNear(const YawShift& a, const YawShift& b, const Vec3& point, double distance_m,
             double angle_rad) {
  return (Apply(a, point) - Apply(b, point)).head<2>().norm() < distance_m &&
         std::abs(WrapAngle(a.yaw - b.yaw)) < angle_rad;
}

std::vector<int> IdsOf(const std::vector<LayoutObject>& objects) {
  std::vector<int> ids;
  for (const LayoutObject& object : objects) ids.push_back(object.id);
  return ids;
}

// A pose is excluded by odometry below this prior. Set by hand. [nats]
constexpr double kExcluded = -10;

// A pose is a copy of a track if its layout fits at least this well relative to the track's: where
// odometry excludes it, it shows that the map repeats itself; elsewhere it is a rival
// (docs/decision.md, "Numbers").
constexpr double kShownCopy = 0.75, kRivalCopy = 0.5;

double LayoutOf(const PoseTrack& track) {
  return track.evidence - track.prior.level - track.prior.height;
}

bool IsExcluded(const PosePrior& prior) { return prior.level + prior.height <= kExcluded; }

// Whether the map has copies of the place of a track: another pose fits nearly as well, and
// odometry excludes it.
bool HasCopies(const PoseTrack& track, const std::vector<PoseTrack>& all) {
  return std::any_of(all.begin(), all.end(), [&](const PoseTrack& other) {
    return &other != &track && IsExcluded(other.prior) &&
           LayoutOf(other) >= kShownCopy * LayoutOf(track);
  });
}

// Number of different objects in the local maps of several attempts.
double CountObjects(const std::vector<PoseTrack::Vote>& votes) {
  std::vector<int> all;
  for (const PoseTrack::Vote& vote : votes)
    all.insert(all.end(), vote.objects.begin(), vote.objects.end());
  std::sort(all.begin(), all.end());
  return static_cast<double>(std::unique(all.begin(), all.end()) - all.begin());
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, PoseTrackOptions& options) {
  visitor.Real("agree_m", options.agree_m, 0, 10000,
               "attempts farther back on the path than this do not count for a track");
  visitor.Everyday("higher: fewer wrong loops where places look alike, and fewer loops")
      .Real("look_alike", options.look_alike, 1e-12, 1,
            "probability that a place that is not in the map looks like one that is");
}

// One attempt: the data common to all tracks, and the tracks so far.
struct PoseTracks::Attempt {
  double path_m;
  std::vector<int> objects;  // ids of the local map's objects
  Vec3 centre;               // of the local map, where poses are compared
  const PoseSearchOptions& search;
  // Number of different objects by first vote and number of votes: tracks of the same age have the
  // same local maps.
  std::map<std::pair<double, std::size_t>, double> different_since;
  std::vector<PoseTrack> tracks;

  bool HasTrackAt(const YawShift& pose) const {
    return std::any_of(tracks.begin(), tracks.end(), [&](const PoseTrack& track) {
      return AreNear(track.pose, pose, centre, search.distinct_m, search.distinct_rad);
    });
  }

  double Different(const std::vector<PoseTrack::Vote>& votes) {
    const auto [known, fresh] = different_since.insert({{votes.front().path_m, votes.size()}, 0});
    if (fresh) known->second = CountObjects(votes);
    return known->second;
  }
};

// mean(score) (different objects in all local maps) / (mean objects in one)
double PoseTracks::SumVotes(const std::vector<PoseTrack::Vote>& votes, Attempt& attempt) {
  double scores = 0, objects = 0;
  for (const PoseTrack::Vote& vote : votes) {
    scores += vote.score;
    objects += static_cast<double>(vote.objects.size());
  }
  return scores * attempt.Different(votes) / objects;
}

void PoseTracks::AddVote(PoseTrack track, const YawShift& pose, const LayoutFit& fit,
                         Attempt& attempt) const {
  track.pose = pose;
  track.fit = fit;
  track.votes.push_back({attempt.path_m, fit.score, attempt.objects});
  while (attempt.path_m - track.votes.front().path_m > options_.agree_m)
    track.votes.erase(track.votes.begin());
  // The drive may have entered the map on the way: votes from before speak of another place.
  double best = SumVotes(track.votes, attempt);
  if (track.prior.joins) {
    const double choice = std::log(static_cast<double>(track.votes.size()));
    for (auto votes = track.votes; votes.size() > 1;) {
      votes.erase(votes.begin());
      best = std::max(best, SumVotes(votes, attempt) - choice);
    }
  }
  track.evidence = track.prior.level + track.prior.height + fit.evidence - fit.score + best;
  attempt.tracks.push_back(std::move(track));
}

void PoseTracks::Update(const LayoutLikelihood& likelihood,
                        const std::vector<PoseHypothesis>& found, const PoseSearchOptions& search,
                        double path_m, double map_end_m, const Prior& prior) {
  const std::vector<LayoutObject>& local = likelihood.local();
  if (local.empty()) return;
  while (!earlier_.empty() && path_m - earlier_.front().path_m > options_.agree_m)
    earlier_.erase(earlier_.begin());
  Attempt attempt{path_m, IdsOf(local), CentreOf(local), search, {}, {}};
  for (PoseTrack& track : tracks_) {
    YawShift pose = track.pose;
    LayoutFit fit = likelihood.Refine(pose, kRefineRounds);
    if (!AreNear(pose, track.pose, attempt.centre, options_.step_m, options_.step_rad)) continue;
    if (static_cast<int>(fit.matches.size()) < search.min_matches) continue;
    if (attempt.HasTrackAt(pose)) continue;
    track.prior = prior(pose, fit);
    AddVote(std::move(track), pose, fit, attempt);
  }
  for (const PoseHypothesis& hypothesis : found) {
    PoseTrack track;
    track.id = next_id_++;
    if (attempt.HasTrackAt(hypothesis.pose)) continue;
    track.prior = prior(hypothesis.pose, hypothesis.fit);
    if (!IsExcluded(track.prior))
      FollowBack(likelihood, hypothesis.pose, search.min_matches, track);
    AddVote(std::move(track), hypothesis.pose, hypothesis.fit, attempt);
  }
  std::vector<PoseTrack>& now = attempt.tracks;
  std::stable_sort(now.begin(), now.end(),
                   [](const PoseTrack& a, const PoseTrack& b) { return a.evidence > b.evidence; });
  if (static_cast<int>(now.size()) > options_.max_tracks) now.resize(options_.max_tracks);
  tracks_ = std::move(now);
  earlier_.push_back({path_m, map_end_m, local});
}

// Adds the votes that a track at `pose` would have got from earlier attempts.
void PoseTracks::FollowBack(const LayoutLikelihood& likelihood, const YawShift& pose,
                            int min_matches, PoseTrack& track) const {
  YawShift now = pose;
  for (auto map = earlier_.rbegin(); map != earlier_.rend(); ++map) {
    YawShift before = now;
    const LayoutFit fit = likelihood.Of(map->objects, map->map_end_m).Refine(before, kRefineRounds);
    if (!AreNear(before, now, CentreOf(map->objects), options_.step_m, options_.step_rad)) break;
    if (static_cast<int>(fit.matches.size()) < min_matches) break;
    track.votes.insert(track.votes.begin(), {map->path_m, fit.score, IdsOf(map->objects)});
    now = before;
  }
}

double PoseTracks::Margin(std::size_t number) const {
  // A place that looks like a track's may be anywhere, also above it: neither of the priors that
  // speak against the track speaks against such a place.
  double alike = -std::numeric_limits<double>::infinity();
  for (const PoseTrack& each : tracks_)
    alike = std::max(alike, each.evidence - each.prior.height - std::min(0., each.prior.level) +
                                std::log(options_.look_alike));
  const double nowhere = LogSumExp({0., alike});
  const PoseTrack* track = number < tracks_.size() ? &tracks_[number] : nullptr;
  const bool has_copies = track && HasCopies(*track, tracks_);
  std::vector<double> others;
  if (track) others.push_back(nowhere);
  for (const PoseTrack& other : tracks_) {
    if (&other == track) continue;
    others.push_back(other.evidence);
    if (has_copies && LayoutOf(other) >= kRivalCopy * LayoutOf(*track))
      others.back() =
          std::max(other.evidence, LayoutOf(*track) + other.prior.level + other.prior.height);
  }
  return (track ? track->evidence : nowhere) - LogSumExp(others);
}

double PoseTracks::Lead() const {
  std::vector<double> others = {0.};
  for (std::size_t i = 1; i < tracks_.size(); ++i) others.push_back(tracks_[i].evidence);
  return tracks_.at(0).evidence - LogSumExp(others);
}

void PoseTracks::Move(const YawShift& change) {
  for (PoseTrack& track : tracks_) {
    // pose o change^-1
    const YawShift before = track.pose;
    track.pose.yaw = WrapAngle(before.yaw - change.yaw);
    track.pose.t = Vec3::Zero();
    track.pose.t = before.t - Apply(track.pose, change.t);
  }
  for (LocalMap& map : earlier_)
    for (LayoutObject& object : map.objects) {
      object.position = Apply(change, object.position);
      object.yaw = WrapAngle(object.yaw + change.yaw);
    }
}

}  // namespace sslcd
