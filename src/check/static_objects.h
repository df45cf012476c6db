// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "check/sequence.h"

namespace sslcd::check {

/// An object that stands still has one place in the world. So its position in one frame, moved by
/// the camera's motion, meets its position in a later frame, if the poses follow the convention.

/// Objects of two frames, with numbers for their labels.
struct Sight {
  int label = 0;
  Vec3 position;  ///< centre in the camera's frame [m]
  const Row* row = nullptr;
};
struct FramePair {
  int first = 0, second = 0;
  std::vector<Sight> before, after;
};

/// x_second = R x_first + t.
struct Motion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vec3 t = Vec3::Zero();
};
/// The motion of the camera between two frames, by number.
using MotionFunction = std::function<Motion(int first, int second)>;
Motion MotionBetween(const Pose& T_world_first, const Pose& T_world_second);
/// `poses` must outlive the function. `correct`, if given, is applied to each of them.
MotionFunction MotionsOf(const std::vector<Pose>& poses,
                         const std::function<Pose(const Pose&)>& correct = {});

/// Pairs of frames `lag` apart, of which each has an object of a label of the other; at most
/// `most`, spread over the run. No pair spans a step whose tracking failed.
std::vector<FramePair> PairsAtLag(const Sequence& sequence, int lag, int most);

/// How far objects of one frame are from the nearest one of their label in the other frame. Of the
/// two directions the one with less scatter counts.
struct Scatter {
  double share = 1;             ///< mean of min(distance, cap) / cap
  double median_m = 0;          ///< of the distances
  std::vector<double> by_pair;  ///< share of each pair
  int objects = 0;
};
Scatter ScatterOf(const std::vector<FramePair>& pairs, const MotionFunction& motions, double cap_m);

/// Pairs of the same time show the same objects, so 20 blocks of pairs are the samples: how many
/// scatter less, or more, with `other`. Both are of the same pairs.
struct BlockVotes {
  int better = 0, worse = 0;
  /// 4 blocks ask for the other, and at most one in 5 of those against it
  bool Decide() const { return better >= 4 && 5 * worse <= better; }
};
BlockVotes CompareBlocks(const Scatter& given, const Scatter& other);

/// The pairs that tell motions apart, of the nearer half of the detections.
struct StaticObjects {
  int lag = 0;
  double cap_m = 0;  ///< half the distance of neighbours of one label, at most 3 m
  std::vector<FramePair> pairs;
  Scatter still;  ///< as if the camera did not move
  int objects = 0;
};

/// The least lag of 1, 2, 4, ... 32 frames at which objects leave their places in the image: their
/// scatter without any motion exceeds half of the cap. None with fewer than `kLeastObjects`
/// objects.
std::optional<StaticObjects> FindStaticObjects(const Sequence& sequence);
constexpr int kLeastObjects = 60, kLeastPairs = 15;

}  // namespace sslcd::check
