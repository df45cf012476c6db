// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/cue.h"
#include "sslcd/core/fields.h"

namespace sslcd {

/// What the table of cues says.
PerCue<CosineStatistics> CosinesOfTable();

/// How alike sightings of one object are, and of two.
struct AppearanceOptions {
  PerCue<CosineStatistics> cosine = CosinesOfTable();  ///< no keys but those of the embedding
  /// most evidence of one object's appearance, for or against [nats]; see CueRow::limit_share, too
  double limit = 3.;
};
void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options);

/// What LayoutLikelihood expects of detector and map.
struct LayoutLikelihoodOptions {
  double wrong_label = 0.03;  ///< share of objects whose class the detector confuses
  /// local objects outside of the area that the map has seen, as on a pass that crosses an older
  /// one, do not count as unmapped
  bool leave_map = true;
  double wrong_height = 0.1;  ///< share of objects whose height is not comparable, e.g. on slopes
  /// no key: Beta priors, in numbers of objects: local objects that the map has and has not, and
  /// mapped objects in sight that are seen again and are not. Set by hand; no search
  /// over them is recorded.
  double mapped_prior = 10., unmapped_prior = 2.;
  double seen_prior = 3., unseen_prior = 1.5;
  AppearanceOptions appearance;
};
void DescribeFields(FieldVisitor& visitor, LayoutLikelihoodOptions& options);

/// How poses of one layout in another one are searched.
struct PoseSearchOptions {
  int refine = 100;     ///< coarse poses that are refined, the best ones
  int min_matches = 4;  ///< objects that have to fit; three fit somewhere in any map
  /// no key: two poses are the same if they take the local map's centre to within `distinct_m` of
  /// each other and differ in yaw by less than `distinct_rad`. Set by hand, about the accuracy of a
  /// coarse pose.
  double distinct_m = 2.;
  double distinct_rad = 0.1;
};
void DescribeFields(FieldVisitor& visitor, PoseSearchOptions& options);

/// How layouts are searched and scored.
struct LayoutMatchOptions {
  double max_pair_m = 50.;  ///< objects that are farther apart do not propose a pose together
  double reach_m = 2.;  ///< a local object is compared with the map's objects within this distance
  PoseSearchOptions search;
  LayoutLikelihoodOptions likelihood;
};
void DescribeFields(FieldVisitor& visitor, LayoutMatchOptions& options);

/// How hypotheses are followed from one attempt to the next.
struct PoseTrackOptions {
  double agree_m = 100.;  ///< attempts farther back on the path do not count
  /// no key: a hypothesis that moves by more than `step_m` or turns by more than `step_rad` from
  /// one attempt to the next is another one. Set by hand.
  double step_m = 3.;
  double step_rad = 0.15;
  int max_tracks = 20;  ///< no key: hypotheses that are followed, the best ones; set by hand
};
void DescribeFields(FieldVisitor& visitor, PoseTrackOptions& options);

/// When the best pose of a single look is accepted. The likelihoods are calibrated: if the place is
/// in the map at all, the log odds are about those of being right. Where it need not be in the map,
/// ask for more: a score of 5 still refuses what only looks alike 9 times of 10, of 10 99 times of
/// 100. Chosen on object-pairs of seeds other than 7 (docs/results.md).
struct SingleLookOptions {
  double min_margin = 0.75;    ///< log odds of the best pose against all others found [nats]
  double min_evidence = -10.;  ///< evidence that chance reaches: competes with the poses [nats]
  double mirror_gain = 5.;     ///< a mirror image that fits better by this refutes the fit [nats]
};
void DescribeFields(FieldVisitor& visitor, SingleLookOptions& options);

/// When the loop of a track is accepted, and when an accepted one is withdrawn. Chosen on HALV-sim
/// (seeds 1 to 10), Victoria Park and the pole sequences; the same for all.
struct LoopAcceptanceOptions {
  /// log odds of its track against all others and against "nowhere" [nats]
  double min_margin = 13.;
  double max_heading_sigma_rad = 0.042;  ///< standard deviation of the measured heading, at most
  double max_apart_m = 30.;              ///< distance between the two cameras, at most
  /// withdrawn where the refined trajectory differs by this or more ...
  double withdraw_m = 2.;
  double withdraw_rad = 0.06;  ///< ... or turns by this or more
};
void DescribeFields(FieldVisitor& visitor, LoopAcceptanceOptions& options);

/// How matched objects are aligned, paper IV-D.
struct DriftOptions {
  bool six_dof = true;           ///< also correct roll and pitch; false: yaw and shift only
  double tilt_sigma_rad = 0.03;  ///< standard deviation of the local map's vertical
  /// scale of the Cauchy loss on each pair's position and heading, in sigmas; 0: none
  double loss_scale = 2.;
  int max_iterations = 30;  ///< of Gauss-Newton, at most; no key: a test raises it
};
void DescribeFields(FieldVisitor& visitor, DriftOptions& options);

/// The paper's two-stage graph matching. It prints none of these values; K and delta are those of
/// the layout test that its authors published, mu weighs both kinds of properties alike, and tau
/// lets an object pass that is half a metre off in size and one metre in position, with vectors of
/// cosine 0.75.
struct PaperMatchOptions {
  int neighbours = 2;              ///< K of IV-A
  double layout_difference = 0.2;  ///< delta of IV-B: candidates have d_f below it
  /// balance of IV-C: 1 geometry only, 0 colour and embedding only
  double mu = 0.5;
  double similarity = 0.7;  ///< tau of IV-C: matches have s_l of at least this, of at most 2
  int min_matches = 2;      ///< "multiple matches" of IV-D
};
void DescribeFields(FieldVisitor& visitor, PaperMatchOptions& options);

}  // namespace sslcd
