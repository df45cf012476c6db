// SPDX-License-Identifier: BSD-3-Clause
// No option that nobody reads: each key, set to another legal value, changes what comes out of one
// of a few small runs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "leaves.h"
#include "loop_drives.h"
#include "sim/appearance.h"

namespace sslcd {
namespace {

// Keys whose effect the small runs below do not show, and the unit test that does.
const std::map<std::string, std::string>& ShownElsewhere() {
  static const std::map<std::string, std::string> keys{
      {"colour.method", "perception/colour_test.cc: images alone are read by it"},
      {"colour.box_share", "perception/colour_test.cc: images alone are read by it"},
      {"filter.max_size_m", "perception/filter_test.cc: no object is that large"},
      {"loop.match.likelihood.appearance.opposite_side",
       "loop/appearance_likelihood_test.cc: both laps go the same way"},
      {"loop.match.likelihood.appearance.same_side",
       "loop/appearance_likelihood_test.cc: with or without it the margin is that of a look-alike"},
      {"loop.match.likelihood.appearance.other_object",
       "loop/appearance_likelihood_test.cc: with or without it the margin is that of a look-alike"},
      {"loop.acceptance.max_risk",
       "loop/decision_test.cc, ARiskAboveTheBarIsAmbiguousButConfirmed: no loop is near the bar"},
      {"loop.graph.drift_factor", "pose_graph/robust_test.cc: no loop is false"},
      {"loop.graph.inlier_probability",
       "pose_graph/robust_test.cc, ALoneLoopIsKeptUpToItsLimit: all loops are good"},
      {"loop.views.reach_m",
       "closing/view_ties_test.cc, ReachAsMuchPathAsTheKeyAllows: the block is small"}};
  return keys;
}

// Twice round a small block with colours and embeddings, behind a car that drives and stops.
Drives SmallWorld() {
  constexpr double kSide = 32, kRadius = 6;
  const std::vector<sim::PathPiece> side{{kSide, 0}, {0.5 * M_PI * kRadius, 1 / kRadius}};
  std::vector<sim::PathPiece> lap;
  for (int i = 0; i < 4; ++i) lap.insert(lap.end(), side.begin(), side.end());
  const sim::Path path(lap, true);
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, 2, world);
  Drive(path, 0, 1.6 * path.length(), world);
  Add("Car", Pose(), world);
  auto& poses = world.objects.back().T_world_object;
  poses.clear();
  for (std::size_t i = 0; i < world.truth.size(); ++i) {
    const double ahead_m = 12 + kStep * static_cast<double>(std::min<std::size_t>(i, 150));
    poses.push_back(path.ObjectAt(ahead_m, 1.5, 0.9, 0.));
  }
  Drives drives(std::move(world), 2);
  sim::DetectorNoise detector;
  detector.max_range_m = 30;
  detector.scale = 1.5;
  detector.wrong_label = 0.05;
  sim::OdometryNoise drift;
  drift.heading_rad_per_sqrt_m = 4e-3;
  drift.tilt_rad_per_sqrt_m = 2e-3;
  drift.scale_error = 0.01;
  sim::SimulatedDetections detections = sim::SimulateDetections(drives.world, detector, 2);
  sim::AddAppearance(drives.world, {}, 2, detections);
  drives.frames = sim::MakeFrames(sim::SimulateOdometry(drives.world.truth, drift, 2), detections);
  return drives;
}

// Measures ties as the truth has them.
ViewAligner TruthAligner(const sim::World& world) {
  return OneByOne([&world](const ViewPair& pair) -> std::optional<RelativePose> {
    const auto& truth = world.truth.poses;
    return RelativePose{truth[pair.a_frame].inverse() * truth[pair.b_frame],
                        1e-4 * Pose::Matrix6::Identity()};
  });
}

class Digest {
 public:
  void Add(double value) {
    char buffer[32];
    text_.append(buffer, std::snprintf(buffer, sizeof buffer, "%.17g ", value));
  }
  void Add(const Pose& pose) {
    for (int i = 0; i < Pose::kParameters; ++i) Add(pose.data()[i]);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// All that a run gives back, to the last bit.
std::string DigestOf(const RunResult& result) {
  Digest digest;
  for (const Pose& pose : result.trajectory.poses) digest.Add(pose);
  for (const LoopClosure& loop : result.loops) {
    digest.Add(loop.score);
    digest.Add(loop.query_frame);
    digest.Add(static_cast<double>(loop.decision));
    digest.Add(loop.T_match_query);
    digest.Add(loop.covariance.trace());
  }
  for (const MapObject& object : result.objects) {
    digest.Add(object.id.value);
    digest.Add(static_cast<double>(object.state));
    digest.Add(object.T_world_object);
    digest.Add(object.dims.sum());
  }
  for (const PoseGraph::Edge& edge : result.graph.edges) digest.Add(edge.information.trace());
  digest.Add(result.views_tied);
  digest.Add(result.scale);
  digest.Add(result.noise_scale.radial);
  digest.Add(result.filter.kept);
  digest.Add(result.refinement.iterations);
  return digest.text();
}

// A run that keys may change.
struct SmallRun {
  const char* name;
  Options options;
  bool aligner = false;  // stereo images tie views
};

std::vector<SmallRun> SmallRuns() {
  Options robust;
  robust.window.keyframe_m = 2;  // so that turns make keyframes, too
  robust.refine.keyframe_m = 3;
  Options views = robust;
  views.loop.views.reach_m = 5;  // so that odometry reaches farther
  return {{"robust", robust}, {"views", views, true}, {"paper", DefaultOptions(Mode::kPaper)}};
}

class KeyEffects : public ::testing::TestWithParam<int> {
 protected:
  std::string Outcome(const SmallRun& run, const Options& options) const {
    MapperContext context = drives_.Context();
    if (run.aligner) context.view_aligner = TruthAligner(drives_.world);
    return DigestOf(RunSequence(drives_.frames, context, options));
  }

  // The key with another legal value; none where `step` leads to none.
  static std::optional<Options> Changed(const Options& base, const Leaf& leaf, int step) {
    Options options = base;
    const Fields fields = [&](FieldVisitor& v) { DescribeFields(v, options); };
    double now = 0;
    for (const Leaf& other : FindLeaves(fields))
      if (other.key == leaf.key) now = std::stod(other.value);
    double value;
    if (!leaf.number) {
      value = now + step + 1 <= leaf.high ? now + step + 1 : now - step - 1;
    } else {
      const double factors[] = {3, 1 / 3., 30, 0, 1.2, 0.8};
      value = now == 0 ? std::min(leaf.high, 1 + 10. * step) : now * factors[step];
      if (leaf.integer) value = std::round(value);
      value = std::min(std::max(value, leaf.low), leaf.high);
    }
    if (value == now) return std::nullopt;
    SetNumber(leaf.key, value, fields);
    if (!Check(options).empty()) return std::nullopt;
    return options;
  }

  bool HasEffect(const Leaf& leaf) {
    for (int step = 0; step < 6; ++step) {
      for (const SmallRun& run : runs_) {
        if (run.aligner != (leaf.key.rfind("loop.views.", 0) == 0)) continue;
        const std::optional<Options> changed = Changed(run.options, leaf, step);
        if (!changed) continue;
        if (before_.count(run.name) == 0) before_[run.name] = Outcome(run, run.options);
        if (Outcome(run, *changed) != before_[run.name]) return true;
      }
    }
    return false;
  }

  const Drives drives_ = SmallWorld();
  const std::vector<SmallRun> runs_ = SmallRuns();
  std::map<std::string, std::string> before_;  // by run
};

constexpr int kShards = 4;

TEST_P(KeyEffects, EveryKeyChangesSomething) {
  Options options;
  const auto leaves = FindLeaves([&](FieldVisitor& v) { DescribeFields(v, options); });
  ASSERT_GT(leaves.size(), 50u);
  for (std::size_t i = GetParam(); i < leaves.size(); i += kShards) {
    if (ShownElsewhere().count(leaves[i].key) == 0) {
      if (!HasEffect(leaves[i])) ADD_FAILURE() << leaves[i].key << " changes nothing";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, KeyEffects, ::testing::Range(0, kShards));

TEST(KeysShownElsewhere, AreKeys) {
  Options options;
  std::map<std::string, int> keys;
  for (const Leaf& leaf : FindLeaves([&](FieldVisitor& v) { DescribeFields(v, options); }))
    ++keys[leaf.key];
  EXPECT_LE(keys.size(), 130u) << "with those of vision, at most 150";
  EXPECT_LE(ShownElsewhere().size(), 12u);
  for (const auto& [key, test] : ShownElsewhere()) EXPECT_EQ(keys[key], 1) << key << ": " << test;
}

}  // namespace
}  // namespace sslcd
