// SPDX-License-Identifier: BSD-3-Clause
#include "closing/view_ties.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "loop_drives.h"
#include "sslcd/core/error.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// 100 m straight ahead, and back on a lane 2 m to the right.
FrameStore ThereAndBack() {
  FrameStore frames;
  for (int i = 0; i <= 200; ++i) {
    FrameRecord frame;
    frame.frame = 1000 + i;
    frame.T_odom_cam = Pose::Trans(0, 0, i);
    const double z = i <= 100 ? i : 200 - i;
    frame.T_world_cam = i <= 100 ? Pose::Trans(0, 0, z) : Pose::Trans(2, 0, z) * Pose::RotY(M_PI);
    frames.Append(frame);
  }
  return frames;
}

RelativePose Measured(const Pose& T) { return {T, 1e-4 * Pose::Matrix6::Identity()}; }

TEST(TieViews, PairsCamerasThatFaceTheSameGround) {
  PathGraph path;
  path.AddShortcut(50, 150);
  LoopOptions options;
  options.views.reach_m = 40;
  int asked = 0, exact = 0;
  const auto frames = ThereAndBack();
  const auto ties =
      TieViews(frames, path, OneByOne([&](const ViewPair& pair) -> std::optional<RelativePose> {
                 const Pose& guess = pair.T_a_b_guess;
                 ++asked;
                 EXPECT_LT(pair.a_frame, pair.b_frame);
                 // Both look at a point 7 m ahead: they stand 14 m apart; some do not where the
                 // reach ends.
                 exact += (guess.translation() - Vec3(2, 0, 14)).norm() < 1e-9;
                 if (asked % 2 == 0) return std::nullopt;
                 return Measured(guess);
               }),
               options);
  EXPECT_GE(asked, 15) << "every 2 m, as far as odometry reaches from the loop";
  EXPECT_LE(asked, 45);
  EXPECT_EQ(static_cast<int>(ties.size()), (asked + 1) / 2)
      << "what could not be aligned is no tie";
  EXPECT_GE(exact, asked - 6);
  for (const ViewTie& tie : ties)
    EXPECT_LE(path.From(frames[tie.to].travelled).To(frames[tie.from].travelled), 40);
}

TEST(TieViews, NoneWhereNoLoopSaysWhereToLook) {
  LoopOptions options;
  options.views.reach_m = 25;  // of plain path, less than gap_m
  const auto never = OneByOne([](const ViewPair&) -> std::optional<RelativePose> {
    ADD_FAILURE();
    return std::nullopt;
  });
  EXPECT_TRUE(TieViews(ThereAndBack(), {}, never, options).empty());
  EXPECT_TRUE(TieViews({}, {}, never, options).empty());
}

TEST(TieViews, ReachAsMuchPathAsTheKeyAllows) {
  const auto frames = ThereAndBack();
  const auto align =
      OneByOne([](const ViewPair& pair) { return std::optional(Measured(pair.T_a_b_guess)); });
  LoopOptions options;
  for (const double reach_m : {40., 80., 120.}) {
    options.views.reach_m = reach_m;
    double farthest_m = 0;
    for (const ViewTie& tie : TieViews(frames, {}, align, options))
      farthest_m = std::max(farthest_m, frames[tie.to].travelled - frames[tie.from].travelled);
    EXPECT_LE(farthest_m, reach_m);
    EXPECT_GT(farthest_m, reach_m - 2 * options.views.every_m);
  }
}

TEST(TieViews, AGoodOdometryNeedsNoLoop) {
  OdometryNoise noise;
  noise.translation_floor_m = noise.translation_walk = 0;
  noise.rotation_walk = 1e-3;
  EXPECT_NEAR(PathUntilDrift(noise, 0.3), std::pow(0.3 * std::sqrt(3.) / 1e-3, 2 / 3.), 5);
  noise.translation_floor_m = 1;
  EXPECT_EQ(PathUntilDrift(noise, 0.3), 0);
  LoopOptions options;
  options.odometry = noise;
  options.odometry.translation_floor_m = 0;
  options.odometry.rotation_walk = 1e-4;
  const auto align =
      OneByOne([](const ViewPair& pair) { return std::optional(Measured(pair.T_a_b_guess)); });
  EXPECT_GT(TieViews(ThereAndBack(), {}, align, options).size(), 20u);
}

/// Aligns by the truth with the error `off` and records the requested frames.
struct TruthAligner {
  const Drives& drives;
  Pose off;
  double limit_m = 1;  ///< of the guess
  int asked = 0, refused = 0;
  std::optional<RelativePose> operator()(const ViewPair& pair) {
    ++asked;
    const auto& truth = drives.world.truth.poses;
    const Pose T = truth[pair.a_frame].inverse() * truth[pair.b_frame];
    if ((T.inverse() * pair.T_a_b_guess).translation().norm() > limit_m) {
      ++refused;
      return std::nullopt;
    }
    Vec6 variances;
    variances << Vec3::Constant(4e-4), Vec3::Constant(1e-6);
    return RelativePose{T * off, variances.asDiagonal()};
  }
};

RunResult RunWith(const Drives& drives, TruthAligner& aligner, const Options& options = {}) {
  MapperContext context = drives.Context();
  context.view_aligner = OneByOne([&](const ViewPair& pair) { return aligner(pair); });
  return RunSequence(drives.frames, context, options);
}

TEST(ViewAligner, MakesTheTrajectoryMoreExactThanObjectsDo) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.3, 1);
  TruthAligner aligner{drives, {}};
  const RunResult plain = drives.Run(), tied = RunWith(drives, aligner);
  EXPECT_GT(aligner.asked, 30);
  EXPECT_LT(aligner.refused, aligner.asked / 4) << "loops of objects make the guess right";
  EXPECT_LT(drives.Judge(tied).ate, drives.Judge(plain).ate);
  const auto off =
      [&](const RunResult& result) {  // where the cameras that were aligned stand to each other
        std::vector<double> errors;
        for (std::size_t i = tied.graph.edges.size() - tied.views_tied; i < tied.graph.edges.size();
             ++i) {
          const PoseGraph::Edge& tie = tied.graph.edges[i];
          const auto& poses = result.trajectory.poses;
          errors.push_back((tie.T_from_to.inverse() * (poses[tie.from].inverse() * poses[tie.to]))
                               .translation()
                               .norm());
        }
        return Median(errors);
      };
  EXPECT_LT(off(tied), 0.4 * off(plain));
  EXPECT_LT(off(tied), 0.05);
  EXPECT_EQ(drives.Judge(tied).wrong_loops, 0);
  EXPECT_EQ(Accepted(tied), Accepted(plain)) << "which loops there are remains what objects say";
  EXPECT_GT(tied.views_tied, (aligner.asked - aligner.refused) * 9 / 10);
  const auto by_views =
      std::count_if(tied.loops.begin(), tied.loops.end(), [](const LoopClosure& loop) {
        return loop.decision == LoopDecision::kAccepted && loop.by_views;
      });
  EXPECT_EQ(tied.graph.edges.size() + by_views, plain.graph.edges.size() + tied.views_tied)
      << "nothing twice";
}

TEST(ViewAligner, NeedsNoObjectsWhereOdometryIsGood) {
  Drives drives = TwoLaps(SecondLap::kOpposite, 0.3, 1);
  for (Frame& frame : drives.frames) frame.detections.clear();
  Options options;
  options.loop.views.reach_m = 1000;
  TruthAligner aligner{drives, {}, 100};
  const RunResult plain = drives.Run(), tied = RunWith(drives, aligner, options);
  EXPECT_GT(tied.views_tied, 30);
  EXPECT_LT(drives.Judge(tied).ate, 0.5 * drives.Judge(plain).ate);
}

TEST(ViewAligner, MeasuresLoopsAnewWhereOdometryIsGood) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.3, 1);
  Options options;  // as of good stereo odometry
  options.loop.odometry.translation_floor_m = options.loop.odometry.translation_walk = 0.003;
  options.loop.odometry.rotation_floor_rad = options.loop.odometry.rotation_walk = 1e-3;
  TruthAligner aligner{drives, {}};
  const auto off = [&](const RunResult& result) {
    std::vector<double> errors;
    const auto& truth = drives.world.truth.poses;
    for (const LoopClosure& loop : result.loops)
      if (loop.decision == LoopDecision::kAccepted)
        errors.push_back((loop.T_match_query.inverse() *
                          (truth[loop.match_frame].inverse() * truth[loop.query_frame]))
                             .translation()
                             .norm());
    return Median(errors);
  };
  const RunResult plain = drives.Run(options), tied = RunWith(drives, aligner, options);
  ASSERT_GT(Accepted(plain), 10);
  ASSERT_GT(Accepted(tied), 10);
  EXPECT_LT(off(tied), 0.9 * off(plain));
  ExpectGoodRows(tied);
}

TEST(ViewAligner, AFewWrongTiesDoLittleHarm) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.3, 1);
  TruthAligner aligner{drives, {}}, right{drives, {}};
  MapperContext context = drives.Context();
  int count = 0;
  context.view_aligner = OneByOne([&](const ViewPair& pair) {
    auto answer = aligner(pair);
    if (answer && ++count % 8 == 0) answer->T_a_b = answer->T_a_b * Pose::Trans(0.8, 0, 0.5);
    return answer;
  });
  Options options;  // as of good odometry: then loops are measured by views
  options.loop.odometry.translation_floor_m = options.loop.odometry.translation_walk = 0.003;
  options.loop.odometry.rotation_floor_rad = options.loop.odometry.rotation_walk = 1e-3;
  const RunResult result = RunSequence(drives.frames, context, options);
  EXPECT_LT(drives.Judge(result).ate,
            1.3 * drives.Judge(RunWith(drives, right, options)).ate + 0.02);
  EXPECT_LE(result.views_tied, count - count / 8) << "wrong ones are noticed";
  const auto& truth = drives.world.truth.poses;
  for (const LoopClosure& loop : result.loops) {
    if (loop.decision != LoopDecision::kAccepted) continue;
    const Pose T_match_query = truth[loop.match_frame].inverse() * truth[loop.query_frame];
    EXPECT_LT((loop.T_match_query.inverse() * T_match_query).translation().norm(), 0.6)
        << "and measure no loop";
  }
}

TEST(TieViews, AnswersThatAreNoneAreLeftOut) {
  LoopOptions options;
  options.views.reach_m = 200;
  int asked = 0;
  const auto align = OneByOne([&](const ViewPair& pair) {
    RelativePose answer = Measured(pair.T_a_b_guess);
    const int kind = asked++ % 5;
    if (kind == 1) answer.covariance(5, 5) = 0;
    if (kind == 2) answer.covariance(0, 0) = NAN;
    if (kind == 3) answer.T_a_b.translation().x() = INFINITY;
    if (kind == 4) answer.T_a_b.data()[3] = 3;
    return std::optional<RelativePose>(answer);
  });
  const std::vector<ViewTie> ties = TieViews(ThereAndBack(), {}, align, options);
  EXPECT_EQ(static_cast<int>(ties.size()), (asked + 4) / 5);
  EXPECT_GT(asked, 8);
}

TEST(TieViews, EachPairNeedsAnAnswer) {
  LoopOptions options;
  options.views.reach_m = 200;
  const auto too_few = [](const std::vector<ViewPair>& pairs) {
    return std::vector<std::optional<RelativePose>>(pairs.size() - 1);
  };
  EXPECT_THROW(TieViews(ThereAndBack(), {}, too_few, options), Error);
}

TEST(ViewAligner, IsNotAskedWithoutLoopsOrWhenSwitchedOff) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.3, 2);
  TruthAligner aligner{drives, {}};
  Options off;
  off.loop.views.enabled = false;
  RunWith(drives, aligner, off);
  off = {};
  off.loop.enabled = false;
  RunWith(drives, aligner, off);
  EXPECT_EQ(aligner.asked, 0);
  EXPECT_FALSE(DefaultOptions(Mode::kPaper).loop.views.enabled);
}

TEST(ViewAligner, RefiningAgainDoesNotAddTies) {
  const Drives drives = TwoLaps(SecondLap::kSame, 0.3, 2);
  TruthAligner aligner{drives, {}};
  MapperContext context = drives.Context();
  context.view_aligner = OneByOne([&](const ViewPair& pair) { return aligner(pair); });
  Mapper mapper({}, context);
  for (const Frame& frame : drives.frames) mapper.AddFrame(frame);
  mapper.Refine();
  const std::vector<ViewTie> ties = mapper.view_ties();
  EXPECT_GT(ties.size(), 10u);
  mapper.Refine();
  EXPECT_NEAR(static_cast<double>(mapper.view_ties().size()), static_cast<double>(ties.size()), 2);
}

}  // namespace
}  // namespace sslcd
