// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "loop/pose_search.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// Prior log odds of a pose against poses uniformly distributed over the searched map. [nats]
struct PosePrior {
  double level = 0;   ///< of its horizontal position and heading
  double height = 0;  ///< of its height, never positive
  /// nothing leads from there to here: odometry was lost, and no loop has joined the two yet
  bool joins = false;
};

/// A pose that several attempts have found.
struct PoseTrack {
  struct Vote {
    double path_m = 0, score = 0;
    std::vector<int> objects;  ///< the local map, by id
  };
  int id = 0;
  YawShift pose;  ///< T_global_local of the last attempt
  LayoutFit fit;  ///< of the last attempt
  PosePrior prior;
  /// log odds of the pose against chance from all attempts [nats]
  double evidence = 0;
  std::vector<Vote> votes;  ///< attempts so far, oldest first
};

/// Temporal consistency: the true pose continues to fit while the camera moves, an accidental one
/// does not. The next attempt evaluates the poses of the previous ones again. Scores add up in
/// proportion to the new objects:
///   evidence = prior + layout, layout = volume + mean(score) (different objects in all local maps)
///   / (mean objects in one)
/// with score and volume of LayoutFit (evidence = score + volume). For one attempt this is
/// LayoutFit's evidence. Where nothing leads from there to here (PosePrior::joins), the camera may
/// have entered the map at any attempt: the votes since the best one count, less the log of the
/// number of choices. A new pose that odometry favours is followed back through the attempts so
/// far, since the search may not have found it there: otherwise older tracks would win by their
/// age.
class PoseTracks {
 public:
  using Prior = std::function<PosePrior(const YawShift&, const LayoutFit&)>;

  explicit PoseTracks(const PoseTrackOptions& options) : options_(options) {}

  /// Adds an attempt at `path_m` of path with the hypotheses that it has found by `likelihood`, in
  /// the global map of the path up to `map_end_m`.
  void Update(const LayoutLikelihood& likelihood, const std::vector<PoseHypothesis>& found,
              const PoseSearchOptions& search, double path_m, double map_end_m, const Prior& prior);

  /// Best first.
  const std::vector<PoseTrack>& tracks() const { return tracks_; }

  /// Log odds of a track against all others and against "nowhere"; those of "nowhere" against all
  /// tracks where there is no track of that number. At least one track. "Nowhere" is a place that
  /// is not in the map: it looks like chance, or like the place of a track. Where the map repeats
  /// itself, only odometry tells a track from its copies. [nats]
  double Margin(std::size_t number) const;

  /// Log odds of the best track against chance and all others: how surely the objects tell it from
  /// anywhere else in the map. Places that are not in the map do not count. [nats]
  double Lead() const;

  /// Transforms the tracks after a change of the local map's coordinates: new = change(old).
  void Move(const YawShift& change);

  /// Removes all tracks. New tracks get new ids.
  void Forget() {
    tracks_.clear();
    earlier_.clear();
  }

 private:
  struct Attempt;
  struct LocalMap {
    double path_m, map_end_m;
    std::vector<LayoutObject> objects;
  };
  static double SumVotes(const std::vector<PoseTrack::Vote>& votes, Attempt& attempt);
  /// Continues or starts a track at `pose`. Its prior is set.
  void AddVote(PoseTrack track, const YawShift& pose, const LayoutFit& fit, Attempt& attempt) const;
  void FollowBack(const LayoutLikelihood& likelihood, const YawShift& pose, int min_matches,
                  PoseTrack& track) const;

  PoseTrackOptions options_;
  std::vector<PoseTrack> tracks_;
  std::vector<LocalMap> earlier_;  // local maps of the attempts that count, oldest first
  int next_id_ = 0;
};

}  // namespace sslcd
