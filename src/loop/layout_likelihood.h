// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "loop/layout_index.h"
#include "loop/semantic_evidence.h"
#include "loop/view_hull.h"
#include "sslcd/core/layout.h"
#include "sslcd/loop/layout_match.h"
#include "sslcd/loop/options.h"

namespace sslcd {

/// Rounds of LayoutLikelihood::Refine with hard matches, which halve the width of the gate. Set by
/// hand.
inline constexpr int kRefineRounds = 4;

/// Standard deviations of one object's position between two maps, per axis. The likelihood
/// marginalises over them. They span the accuracy of maps from stereo to monocular boxes; set by
/// hand. [m]
inline constexpr double kPlaceSigmas[] = {0.15, 0.3, 0.5, 0.8};

/// The objects of an index that a local layout may match.
struct MapLimits {
  /// Altitudes differ by no more. [m]
  double max_rise_m = std::numeric_limits<double>::infinity();
  /// LayoutObject::since_m is before this path length: the map as it was then. [m]
  double end_m = std::numeric_limits<double>::infinity();
};

/// The log likelihood ratio of two hypotheses about a local layout: it shows the map under a pose,
/// or other objects at random places with the map's density. Its unit, nats, makes dense car parks
/// and isolated poles comparable. Rare labels count more than frequent ones. Evaluates poses of one
/// local layout in one map. Refers to both, which must outlive it. Positions must be finite. It has
/// caches, so it is not thread-safe.
class LayoutLikelihood {
 public:
  LayoutLikelihood(const std::vector<LayoutObject>& local, const LayoutIndex& index,
                   const LayoutLikelihoodOptions& options, const MapLimits& limits = {});

  /// The same for another local layout, which must outlive it, and the map as it was at `end_m`.
  LayoutLikelihood Of(const std::vector<LayoutObject>& local, double end_m) const {
    return LayoutLikelihood(local, index_, options_, {limits_.max_rise_m, end_m});
  }

  const std::vector<LayoutObject>& local() const { return local_; }
  const LayoutIndex& index() const { return index_; }

  /// Matches the objects under `pose` and scores the pose.
  LayoutFit Evaluate(const YawShift& pose) const;

  /// Moves the pose to where the matches agree best (closed form, a few rounds) and evaluates
  /// there. Remembers the way: a start that leads to a pose where an earlier one has been costs
  /// little. Gives up, with a fit without matches, once hard matches score less than `least_score`.
  LayoutFit Refine(YawShift& pose, int rounds,
                   double least_score = -std::numeric_limits<double>::infinity()) const;

 private:
  struct Candidate {
    int local, global;
    double d2, z2;         // squared horizontal and vertical distance [m^2]
    double semantic_gain;  // label, heading, appearance [nats]
    bool in_view;          // the map's object is in the area of the local ones
  };
  struct Ranked {
    double gain;  // evidence of the match alone [nats]
    const Candidate* candidate;
  };
  struct RefinedPose {
    YawShift pose;
    LayoutFit fit;
  };
  using RefineKey = std::array<double, 6>;  // rounds asked for, round, pose
  std::vector<Candidate> Candidates(const YawShift& pose, bool with_view) const;
  RefinedPose RefineByLikelihood(const YawShift& pose) const;
  YawShift Align(const LayoutFit& fit) const;
  int CountInMappedArea(const YawShift& pose) const;
  bool IsMapped(double x, double y) const;
  int CountInView(const YawShift& pose) const;
  bool InView(const Vec3& global, const Vec3& t, double c, double s) const;
  std::vector<Ranked> RankByGain(const std::vector<Candidate>& candidates, double sigma) const;
  LayoutFit Assign(const std::vector<Candidate>& candidates, int in_view, int on_map,
                   double sigma) const;

  const std::vector<LayoutObject>& local_;
  const LayoutIndex& index_;
  LayoutLikelihoodOptions options_;
  MapLimits limits_;
  SemanticEvidence semantics_;
  ViewHull view_;
  // log probability that none of n objects is mapped, by n
  std::vector<double> none_mapped_;
  mutable std::unordered_map<std::uint64_t, bool> mapped_;  // LayoutIndex::IsMapped, by block
  // where a way through a pose has led
  mutable std::map<RefineKey, std::shared_ptr<const RefinedPose>> refine_cache_;
};

/// Least-squares pose of matched points: p_to ~ Rz(yaw) p_from + t. The yaw is 0 without two
/// different points.
YawShift AlignPoints(const std::vector<Vec3>& from, const std::vector<Vec3>& to);

/// Applies a pose to a point.
Vec3 Apply(const YawShift& pose, const Vec3& point);

}  // namespace sslcd
