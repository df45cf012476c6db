// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/pose_search.h"

#include <algorithm>
#include <cmath>

#include "loop/coarse_poses.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, PoseSearchOptions& options) {
  visitor.Real("min_pair_m", options.min_pair_m, 0.1, 100,
               "closer pairs of objects fix the yaw too badly");
  visitor.Real("pair_noise_m", options.pair_noise_m, 0.01, 10,
               "how far the distances of two equal pairs may differ");
  visitor.Real("inlier_m", options.inlier_m, 0.1, 20,
               "coarse score: objects further apart do not fit");
  visitor.Integer("pairs_per_object", options.pairs_per_object, 1, 1000,
                  "local pairs tried per object, rarest first");
  visitor.Integer("refine", options.refine, 1, 100000, "coarse poses that are refined");
  visitor.Integer("min_matches", options.min_matches, 3, 1000, "objects that have to fit at least");
  visitor.Real("distinct_m", options.distinct_m, 0.1, 100,
               "poses that take the centre to within this are one ...");
  visitor.Real("distinct_rad", options.distinct_rad, 0.001, 3.2,
               "... if they differ in yaw by less than this");
}

std::vector<PoseHypothesis> SearchPoses(const LayoutLikelihood& likelihood,
                                        const PoseSearchOptions& options) {
  const std::vector<LayoutObject>& local = likelihood.local();
  const LayoutIndex& index = likelihood.index();
  std::vector<PoseHypothesis> found;
  if (local.size() < 2 || index.objects().size() < 2) return found;
  Vec3 centre = Vec3::Zero();
  for (const LayoutObject& object : local)
    centre += object.position / static_cast<double>(local.size());
  for (const CoarsePose& start : CoarsePoses(local, centre, index, options)) {
    PoseHypothesis hypothesis;
    YawShift& pose = hypothesis.pose;
    pose.yaw = std::atan2(start.sine, start.cosine);
    pose.t = Vec3::Zero();
    pose.t = Vec3(start.x, start.y, start.z) - Apply(pose, centre);
    hypothesis.fit = likelihood.Refine(pose, 4);
    if (static_cast<int>(hypothesis.fit.matches.size()) >= options.min_matches)
      found.push_back(hypothesis);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const PoseHypothesis& a, const PoseHypothesis& b) {
                     return a.fit.evidence > b.fit.evidence;
                   });
  std::vector<PoseHypothesis> distinct;
  for (const PoseHypothesis& hypothesis : found) {
    const bool known =
        std::any_of(distinct.begin(), distinct.end(), [&](const PoseHypothesis& other) {
          return (Apply(other.pose, centre) - Apply(hypothesis.pose, centre)).head<2>().norm() <
                     options.distinct_m &&
                 std::abs(WrapAngle(other.pose.yaw - hypothesis.pose.yaw)) < options.distinct_rad;
        });
    if (!known) distinct.push_back(hypothesis);
  }
  return distinct;
}

}  // namespace sslcd
