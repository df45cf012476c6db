// SPDX-License-Identifier: BSD-3-Clause
#include "association/associate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "association/assignment.h"
#include "association/score.h"

namespace sslcd {
namespace {

// Factor on the score of a prediction relative to the previous one. Set by hand.
constexpr double kLessPlausible = 0.5;

SimilarityCues Compare(const AssociationQuery& query, const AssociationCandidate& candidate) {
  SimilarityCues cues;
  const Detection& detection = *query.detection;
  // A landmark without a projection is out of view: its overlap with a detected box is zero, not
  // missing.
  if (detection.box)
    cues.iou = candidate.projected_box ? Iou(*detection.box, *candidate.projected_box) : 0.;
  if (candidate.appearance == nullptr) return cues;
  for (const CueRow& row : kCueRows)  // Eqs. 5 and 6
    cues.appearance[row.cue] = (*candidate.appearance)[row.cue].Compare(
        detection.appearance[row.cue], query.viewpoint_rad);
  return cues;
}

// exp(-d^2/4) of the horizontal Mahalanobis distance from the best predicted position; 0 outside
// the gates. A less plausible prediction counts half, so that a parked landmark wins against a
// predicted motion.
double Geometry(const AssociationQuery& query, const AssociationCandidate& candidate,
                const AssociationOptions& options) {
  if (std::abs(query.height - candidate.height) > options.gate_vertical_m) return 0;
  double best = 0, plausibility = 1;
  for (const PlanarGaussian& prediction : candidate.predictions) {
    const Eigen::Vector2d difference = query.place.position - prediction.position;
    const Eigen::Matrix2d covariance = query.place.covariance + prediction.covariance;
    const double squared = difference.dot(covariance.inverse() * difference);
    if (squared <= options.gate_sigmas * options.gate_sigmas && difference.norm() <= options.gate_m)
      best = std::max(best, plausibility * std::exp(-0.25 * squared));
    plausibility *= kLessPlausible;
  }
  return best;
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, AssociationOptions& options) {
  visitor.Enum(
      "method", options.method, {"robust", "paper"},
      "robust: gates by distance, geometry counts, one-to-one; paper: Eqs. 2-6 as printed");
  visitor.Real("lambda", options.lambda, 0, 1,
               "Eq. 3: balance between box overlap, colour and embedding");
  visitor.Real("min_score", options.min_score, 0, 1, "pairs with a lower score are never matched");
  visitor.Real("geometry_weight", options.geometry_weight, 0, 1,
               "robust: weight of the 3D distance in the score; the rest is that of Eq. 3");
  visitor.Real("gate_sigmas", options.gate_sigmas, 0.1, 100,
               "robust: largest horizontal Mahalanobis distance of a match");
  visitor.Everyday("larger: fewer double landmarks, but more detections join a neighbour")
      .Real("gate_m", options.gate_m, 0.01, 1000, "robust: largest horizontal distance of a match");
  visitor.Real("gate_vertical_m", options.gate_vertical_m, 0.01, 1000,
               "robust: largest vertical distance of a match");
}

Eigen::MatrixXd AssociationMatrix(const std::vector<AssociationQuery>& queries,
                                  const std::vector<AssociationCandidate>& candidates,
                                  const AssociationOptions& options) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(queries.size(), candidates.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (queries[i].detection->label != candidates[k].label) continue;  // Eq. 2
      const auto appearance = [&] {
        return AssociationScore(Compare(queries[i], candidates[k]), options.lambda);
      };
      double score = 0;
      if (options.method == AssociationOptions::Method::kPaper) {
        score = appearance().value_or(0.);
      } else if (const double geometry = Geometry(queries[i], candidates[k], options);
                 geometry > 0) {
        const auto s_d = appearance();
        score = s_d ? options.geometry_weight * geometry + (1 - options.geometry_weight) * *s_d
                    : geometry;
      }
      if (score >= options.min_score) W(i, k) = score;
    }
  }
  return W;
}

std::vector<int> Associate(const std::vector<AssociationQuery>& queries,
                           const std::vector<AssociationCandidate>& candidates,
                           const AssociationOptions& options) {
  return MaximumAssignment(AssociationMatrix(queries, candidates, options));
}

}  // namespace sslcd
