// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/cue.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"

namespace SSLCD_EXPORT sslcd {

/// The CosineStatistics of all rows of kCueRows.
PerCue<CosineStatistics> CosinesOfTable();

/// The similarity of sightings of the same object and of different objects.
struct AppearanceOptions {
  PerCue<CosineStatistics> cosine = CosinesOfTable();  ///< only the embedding has keys
  /// largest absolute evidence of one object's appearance [nats]; see also CueRow::limit_share
  double limit = 3.;
};
void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options);

/// Options of LayoutLikelihood: the expected errors of detector and map.
struct LayoutLikelihoodOptions {
  double wrong_label = 0.03;  ///< share of objects whose class the detector confuses
  /// local objects outside of the mapped area do not count as unmapped, e.g. on a pass that crosses
  /// an older one
  bool leave_map = true;
  double wrong_height = 0.1;  ///< share of objects whose height is not comparable, e.g. on slopes
  /// no key: Beta priors in numbers of objects: local objects with and without a map object, and
  /// visible map objects that are seen again and that are missed. Set by hand without a recorded
  /// search.
  double mapped_prior = 10., unmapped_prior = 2.;
  double seen_prior = 3., unseen_prior = 1.5;
  AppearanceOptions appearance;
};
void DescribeFields(FieldVisitor& visitor, LayoutLikelihoodOptions& options);

/// How poses of one layout in another one are searched.
struct PoseSearchOptions {
  int refine = 100;     ///< no key: number of the best coarse poses that are refined; set by hand
  int min_matches = 4;  ///< smallest number of matched objects; three match somewhere in any map
  /// no key: two poses are equal if they map the local map's centre to points closer than
  /// `distinct_m` and their yaws differ by less than `distinct_rad`. Set by hand to the accuracy of
  /// a coarse pose.
  double distinct_m = 2.;
  double distinct_rad = 0.1;  ///< see `distinct_m`
};
void DescribeFields(FieldVisitor& visitor, PoseSearchOptions& options);

/// Options of the search and the scoring of poses.
struct LayoutMatchOptions {
  double max_pair_m = 50.;  ///< largest distance of two objects that propose a pose
  double reach_m = 2.;  ///< largest distance of a map object that a local object is compared with
  PoseSearchOptions search;
  LayoutLikelihoodOptions likelihood;
};
void DescribeFields(FieldVisitor& visitor, LayoutMatchOptions& options);

/// Options of tracking hypotheses from one attempt to the next.
struct PoseTrackOptions {
  double agree_m = 100.;  ///< largest path from an attempt that counts
  /// Probability that a place outside of the map looks like one in it. The odds of a pose are at
  /// most 1 / look_alike, less what odometry has against it. e^-8, see docs/decision.md.
  double look_alike = 3.4e-4;
  /// no key: largest translation and rotation of a hypothesis from one attempt to the next. Set by
  /// hand.
  double step_m = 3.;
  double step_rad = 0.15;  ///< see `step_m`
  int max_tracks = 20;     ///< no key: largest number of tracks; set by hand
};
void DescribeFields(FieldVisitor& visitor, PoseTrackOptions& options);

/// Acceptance of the best pose of one pair of maps. The likelihoods are calibrated: if the place is
/// in the map, the log odds are approximately those of a correct pose. If the place may be absent,
/// require more: a score of 5 refuses 9 of 10 similar places, a score of 10 refuses 99 of 100.
/// Chosen on object-pairs of seeds other than 7 (docs/results.md).
struct SingleLookOptions {
  double min_margin = 0.75;  ///< smallest log odds of the best pose against all others [nats]
  /// evidence that chance reaches, which competes with the poses [nats]
  double min_evidence = -10.;
  double mirror_gain = 5.;  ///< a mirror image that fits better by this refutes the fit [nats]
};
void DescribeFields(FieldVisitor& visitor, SingleLookOptions& options);

/// Acceptance of the loop of a track, and withdrawal of accepted loops. Chosen on HALV-sim (seeds 1
/// to 10), Victoria Park and the pole sequences, with the same values for all.
struct LoopAcceptanceOptions {
  /// Largest probability that the track is wrong, by its odds against all others and against
  /// "nowhere". It is never below PoseTrackOptions::look_alike.
  double max_risk = 0.0067;
  double max_heading_sigma_rad = 0.07;  ///< largest standard deviation of the measured heading
  /// a loop is withdrawn if the refined trajectory differs by at least this distance
  double withdraw_m = 2.;
  double withdraw_rad = 0.06;  ///< or by at least this angle
};
void DescribeFields(FieldVisitor& visitor, LoopAcceptanceOptions& options);

/// How matched objects are aligned, paper IV-D.
struct DriftOptions {
  bool six_dof = true;           ///< also correct roll and pitch; false: yaw and shift only
  double tilt_sigma_rad = 0.03;  ///< standard deviation of the local map's vertical
  /// scale of the Cauchy loss on each pair's position and heading, in sigmas; 0: none
  double loss_scale = 2.;
  int max_iterations = 30;  ///< of Gauss-Newton; no key: only a test changes it
};
void DescribeFields(FieldVisitor& visitor, DriftOptions& options);

/// Options of the paper's two-stage graph matching. The paper prints none of these values. K and
/// delta are from the layout test that its authors published. mu weights both kinds of properties
/// equally. tau accepts an object with errors of half a metre in size and one metre in position,
/// and vectors of cosine 0.75.
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
