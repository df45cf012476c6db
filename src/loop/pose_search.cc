// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math.h"
#include "loop/coarse_poses.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, PoseSearchOptions& options) {
  visitor.Everyday("higher: fewer loops, and more certain ones")
      .Integer("min_matches", options.min_matches, 3, 1000,
               "objects that have to fit for a pose to count");
}

namespace {

Vec3 CentreOfObjects(const std::vector<LayoutObject>& objects) {
  Vec3 centre = Vec3::Zero();
  for (const LayoutObject& object : objects)
    centre += object.position / static_cast<double>(objects.size());
  return centre;
}

std::vector<YawShift> AsStarts(const std::vector<CoarsePose>& coarse_poses, const Vec3& centre) {
  std::vector<YawShift> starts;
  for (const CoarsePose& coarse : coarse_poses) {
    YawShift& pose = starts.emplace_back();
    pose.yaw = std::atan2(coarse.sine, coarse.cosine);
    pose.t = Vec3(coarse.x, coarse.y, coarse.z) - Apply(pose, centre);
  }
  return starts;
}

// The poses to refine: the best coarse ones, and the best of the prior among more of them.
std::vector<YawShift> Starts(const std::vector<LayoutObject>& local, const Vec3& centre,
                             const LayoutIndex& index, PoseSearchOptions options,
                             const std::function<double(const YawShift&)>& prior) {
  constexpr int kMore = 10;
  const std::size_t refine = options.refine;
  if (prior) options.refine *= kMore;
  std::vector<YawShift> starts = AsStarts(CoarsePoses(local, centre, index, options).best, centre);
  if (starts.size() <= refine) return starts;
  std::vector<std::pair<double, YawShift>> rest;
  for (std::size_t i = refine; i < starts.size(); ++i)
    rest.emplace_back(prior(starts[i]), starts[i]);
  std::stable_sort(rest.begin(), rest.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  starts.resize(refine);
  for (std::size_t i = 0; i < std::min(refine, rest.size()); ++i) starts.push_back(rest[i].second);
  return starts;
}

// Score of the first matches below which a start is given up: an eighth to nearly all of the
// starts, and the evidence that they would have reached was at most -15 on all sequences. [nats]
constexpr double kHopeless = -4;

// Refines the poses and keeps the best of equal ones, best first.
std::vector<PoseHypothesis> RefineAll(const std::vector<YawShift>& starts,
                                      const LayoutLikelihood& likelihood, const Vec3& centre,
                                      const PoseSearchOptions& options) {
  std::vector<PoseHypothesis> found;
  for (const YawShift& start : starts) {
    PoseHypothesis hypothesis;
    hypothesis.pose = start;
    hypothesis.fit = likelihood.Refine(hypothesis.pose, kRefineRounds, kHopeless);
    if (static_cast<int>(hypothesis.fit.matches.size()) >= options.min_matches)
      found.push_back(std::move(hypothesis));
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

// A pose needs two objects on either side.
bool HasPoses(const LayoutLikelihood& likelihood) {
  return likelihood.local().size() >= 2 && likelihood.index().objects().size() >= 2;
}

}  // namespace

std::vector<PoseHypothesis> SearchPoses(const LayoutLikelihood& likelihood,
                                        const PoseSearchOptions& options,
                                        const std::function<double(const YawShift&)>& prior) {
  if (!HasPoses(likelihood)) return {};
  const Vec3 centre = CentreOfObjects(likelihood.local());
  return RefineAll(Starts(likelihood.local(), centre, likelihood.index(), options, prior),
                   likelihood, centre, options);
}

SearchedPoses SearchAllPoses(const LayoutLikelihood& likelihood, const PoseSearchOptions& options) {
  SearchedPoses searched;
  if (!HasPoses(likelihood)) return searched;
  const Vec3 centre = CentreOfObjects(likelihood.local());
  const CoarseSearch coarse = CoarsePoses(likelihood.local(), centre, likelihood.index(), options);
  searched.looked_at = coarse.looked_at;
  searched.found = RefineAll(AsStarts(coarse.best, centre), likelihood, centre, options);
  if (searched.found.empty()) return searched;
  std::vector<double> evidence;
  for (const PoseHypothesis& hypothesis : searched.found)
    evidence.push_back(hypothesis.fit.evidence);
  searched.left_out = LogSumExp(evidence) + coarse.left_out;
  return searched;
}

}  // namespace sslcd
