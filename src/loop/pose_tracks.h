// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "loop/pose_search.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// A pose that has been a hypothesis for a while.
struct PoseTrack {
  struct Vote {
    double path_m = 0, score = 0;
    std::vector<int> objects;  ///< the local map, by id
  };
  int id = 0;
  YawShift pose;     ///< local to global, as the last attempt has it
  LayoutFit fit;     ///< of the last attempt
  double prior = 0;  ///< log odds of the pose before any object was looked at
  /// log odds that all attempts together speak for it rather than chance [nats]
  double evidence = 0;
  std::vector<Vote> votes;  ///< of the attempts so far, oldest first
};

/// Temporal agreement: the true pose goes on fitting as the camera moves on, an accidental one does
/// not. Poses found by one attempt are looked at again in the next; what they score there adds up,
/// but only as far as new objects have come in:
///   evidence = prior + volume + mean(score) (different objects in all local maps) / (mean objects
///   in one)
/// where score and volume are those of LayoutFit (evidence = score + volume). With one attempt this
/// is LayoutFit's own evidence.
class PoseTracks {
 public:
  using Prior = std::function<double(const YawShift&, const LayoutFit&)>;

  explicit PoseTracks(const PoseTrackOptions& options) : options_(options) {}

  /// One more attempt, after `path_m` of path, and the hypotheses it has found by `likelihood`.
  void Update(const LayoutLikelihood& likelihood, const std::vector<PoseHypothesis>& found,
              const PoseSearchOptions& search, double path_m, const Prior& prior);

  /// Best first.
  const std::vector<PoseTrack>& tracks() const { return tracks_; }

  /// Log odds of a track against all others and against "nowhere". [nats]
  double Margin(std::size_t track) const;

  /// The local map's coordinates have changed: new = change(old).
  void Move(const YawShift& change);

  /// Starts again; new tracks get new ids.
  void Forget() { tracks_.clear(); }

 private:
  PoseTrackOptions options_;
  std::vector<PoseTrack> tracks_;
  int next_id_ = 0;
};

}  // namespace sslcd
