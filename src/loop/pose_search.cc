// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_search.h"

#include <algorithm>
#include <cmath>

#include "loop/coarse_poses.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, PoseSearchOptions& options) {
  visitor.Everyday("higher: fewer loops, and more certain ones")
      .Integer("min_matches", options.min_matches, 3, 1000,
               "objects that have to fit for a pose to count");
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
    hypothesis.fit = likelihood.Refine(pose, kRefineRounds);
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
