// SPDX-License-Identifier: BSD-3-Clause
// Which object loop goes to which keyframe of VINS. Knows neither ROS nor VINS.
#pragma once

#include <map>
#include <vector>

#include "rig.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd::vins {

/// An accepted loop between two keyframes, as VINS's pose graph takes it.
struct LoopEdge {
  int id = 0;             ///< LoopClosure::id
  int cur = 0, old = 0;   ///< KeyFrame::index; old < cur
  RelativePose measured;  ///< T_old_cur of the bodies, in the odometry's unit
};

/// Keyframes whose loop has to be set, and those that lose theirs.
struct EdgeChanges {
  std::vector<LoopEdge> set;
  std::vector<int> cleared;  ///< KeyFrame::index
  bool empty() const { return set.empty() && cleared.empty(); }
};

/// The loop between the bodies of two keyframes. `loop` is metric and between cameras; `scale`:
/// metres per odometry metre.
LoopEdge EdgeBetween(const LoopClosure& loop, const Keyframe& cur, const Keyframe& old,
                     double scale);

/// The same loop, measured from `to` instead of `from` by the odometry between them, which lies in
/// the same sequence.
LoopEdge MovedTo(const Keyframe& to, const Keyframe& from, const LoopEdge& edge);

/// Assigns accepted loops to keyframes. A keyframe of VINS holds one loop, so:
/// - VINS's own loop stays.
/// - Of several loops at a keyframe, that with the smallest covariance (determinant) stays.
/// - Any other loop moves to the nearest keyframe of its sequence that is free and not more than
///   kMostMoved away in index. If there is none, it waits.
class LoopBook {
 public:
  static constexpr int kMostMoved = 5;

  void AddKeyframe(const Keyframe& keyframe) { keyframes_[keyframe.index] = keyframe; }
  const Keyframe* Find(int index) const;

  /// Takes loops that are new or have changed (MapChanges::loops). A loop that is no longer
  /// accepted is withdrawn. Edges whose scale has changed are set again. O(accepted loops).
  EdgeChanges Update(const std::vector<LoopClosure>& changed, double scale);

  int accepted() const { return static_cast<int>(accepted_.size()); }
  const std::map<int, LoopEdge>& edges() const { return edges_; }  ///< by `cur`

 private:
  std::map<int, LoopEdge> Assign(double scale) const;
  const Keyframe* NearestFree(const LoopEdge& edge, const std::map<int, LoopEdge>& taken) const;

  std::map<int, Keyframe> keyframes_;
  std::map<int, LoopClosure> accepted_;  // by id
  std::map<int, LoopEdge> edges_;
};

}  // namespace sslcd::vins
