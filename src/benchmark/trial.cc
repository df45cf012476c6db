// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/trial.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include "sslcd/pipeline/run.h"

namespace sslcd::benchmark {
namespace {

// Records the answers that a matcher would accept, and passes none on.
PlaceMatcher OnlyAsked(PlaceMatcher matcher, std::set<int>& accepted) {
  return [matcher = std::move(matcher), &accepted](const PlaceQuery& query) {
    std::optional<PlaceAnswer> answer = matcher(query);
    if (answer && answer->accepted) accepted.insert(query.frame);
    if (answer) answer->accepted = false;
    return answer;
  };
}

}  // namespace

std::string Trial::World() const {
  return place.key + "-c" + std::to_string(case_number) + "-s" + std::to_string(seed);
}

std::string Trial::Name() const {
  return World() + "-" + method.key + (only_asked ? "-asked" : "");
}

sim::HalvSequence MakeSequence(const Trial& trial) {
  sim::HalvOptions options;
  options.scene = trial.place.scene;
  options.scene.case_number = trial.case_number;
  return sim::MakeHalv(trial.seed, options);
}

TrialResult RunTrial(const Trial& trial, const sim::HalvSequence& sequence) {
  const sim::World& world = sequence.scene.world;
  const std::vector<Frame> frames = sim::MakeFrames(sequence.odometry, sequence.detections);
  MapperContext context{world.gravity, world.labels, world.camera};
  std::set<int> accepted;
  if (trial.method.matcher) context.place_matcher = trial.method.matcher(trial.World());
  if (trial.only_asked)
    context.place_matcher = OnlyAsked(std::move(context.place_matcher), accepted);

  const auto start = std::chrono::steady_clock::now();
  RunResult run = RunSequence(frames, context, trial.method.options);
  TrialResult result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (LoopClosure& loop : run.loops)
    if (accepted.count(loop.newest_frame) > 0) loop.decision = LoopDecision::kAccepted;

  const std::vector<Pose>& truth = world.truth.poses;
  result.ate = ComputeAte(run.trajectory.poses, truth, Alignment::kSim3).error;
  result.ate_se3 = ComputeAte(run.trajectory.poses, truth, Alignment::kSe3).error;
  result.ate_odometry = ComputeAte(sequence.odometry.poses, truth, Alignment::kSim3).error;
  result.scene_viewpoint_rad = sequence.scene.viewpoint_rad;
  result.revisits = FindRevisits(truth, frames, sequence.detections.identity);
  if (trial.place.way_back_only) {
    std::vector<Revisit>& all = result.revisits;
    const auto out = [&](const Revisit& revisit) {
      return revisit.frame < sequence.scene.return_frame;
    };
    all.erase(std::remove_if(all.begin(), all.end(), out), all.end());
  }
  result.loops = MeasureLoopErrors(run.loops, truth);
  result.times = run.timing.Summary();
  return result;
}

}  // namespace sslcd::benchmark
