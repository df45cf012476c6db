// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_heights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sslcd {
namespace {

constexpr int kOneWay = 300;  // frames, a metre a frame

// Out and back along one line over a hill, with a drift of the odometry's heights. Every tenth
// camera of the way back sees a place of the way out.
struct OutAndBack {
  FrameStore frames;
  LoopLedger loops;
  std::vector<ViewTie> ties;
  std::vector<double> truth;  // height of each frame [m]

  OutAndBack(double drift, double noise, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Vec3 up = GravityFrame{}.up;
    double error = 0;
    for (int i = 0; i < 2 * kOneWay; ++i) {
      const int place = PlaceOf(i);
      truth.push_back(5 * std::sin(0.01 * place));
      error += i > 0 ? drift * normal(random) : 0;
      FrameRecord record;
      record.frame = i;
      record.stamp = i;
      record.T_input_cam = Pose(lie::SO3<double>::RotY(i < kOneWay ? 0 : M_PI),
                                Vec3(0, 0, place) + (truth.back() + error) * up);
      record.T_odom_cam = record.T_world_cam = record.T_input_cam;
      frames.Append(record);
    }
    for (int query = kOneWay + 20; query < 2 * kOneWay; query += 10) {
      FoundLoop found;
      found.loop.match = PlaceOf(query);
      found.loop.query = query;
      found.loop.row.decision = LoopDecision::kAccepted;
      found.loop.row.T_match_query =
          Pose(lie::SO3<double>::RotY(M_PI), noise * normal(random) * up);
      loops.Add(found, {}, query);
    }
  }
  static int PlaceOf(int frame) { return frame < kOneWay ? frame : 2 * kOneWay - 1 - frame; }
  HeightCorrection Correct() const {
    return HeightsByLoops(frames, loops, ties, GravityFrame{}.up);
  }
  double Rms(const std::vector<double>& rise_m) const {
    Eigen::VectorXd error(frames.size());
    for (int i = 0; i < frames.size(); ++i)
      error[i] = frames[i].T_input_cam.translation().dot(GravityFrame{}.up) + rise_m[i] - truth[i];
    return std::sqrt((error.array() - error.mean()).square().mean());
  }
};

TEST(HeightsByLoops, CorrectADrift) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const OutAndBack drive(0.1, 0.1, seed);
    const HeightCorrection correction = drive.Correct();
    EXPECT_GT(correction.probability, 0.975) << seed;
    EXPECT_LT(drive.Rms(correction.rise_m), 0.8 * drive.Rms(std::vector<double>(2 * kOneWay, 0.)))
        << seed;
  }
}

TEST(HeightsByLoops, LeaveExactHeightsAsTheyAre) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const OutAndBack drive(0, 0.2, seed);
    const HeightCorrection correction = drive.Correct();
    EXPECT_LT(correction.probability, 0.975) << seed;
    EXPECT_LT(drive.Rms(correction.rise_m), 0.1) << seed;
  }
}

TEST(HeightsByLoops, SayNothingWithoutLoops) {
  OutAndBack drive(0.1, 0.1);
  drive.loops = {};
  const HeightCorrection correction = drive.Correct();
  EXPECT_EQ(correction.rise_m, std::vector<double>(2 * kOneWay, 0.));
  EXPECT_EQ(correction.probability, 0.5);
}

TEST(HeightsByLoops, TakeTheLastMeasurementOfAcceptedLoopsOnly) {
  OutAndBack drive(0, 0);
  for (LoopAttempt& attempt : drive.loops.attempts()) {
    attempt.remeasured = attempt.row();
    attempt.row().T_match_query.translation() += 3 * GravityFrame{}.up;
  }
  LoopAttempt& refused = drive.loops.attempts()[3];
  refused.remeasured = refused.row();
  refused.row().decision = LoopDecision::kAmbiguous;
  EXPECT_LT(drive.Rms(drive.Correct().rise_m), 1e-6);
}

TEST(HeightsByLoops, AlignedViewsCountByTheirCovariance) {
  OutAndBack drive(0.1, 0.3);
  const double by_objects = drive.Rms(drive.Correct().rise_m);
  for (int query = kOneWay + 20; query < 2 * kOneWay; query += 10) {
    const int match = OutAndBack::PlaceOf(query);
    Vec6 variances;
    variances << Vec3::Constant(1e-4), Vec3::Constant(1e-6);
    drive.ties.push_back(
        {match, query, {Pose(lie::SO3<double>::RotY(M_PI), Vec3::Zero()), variances.asDiagonal()}});
  }
  const HeightCorrection correction = drive.Correct();
  EXPECT_LT(drive.Rms(correction.rise_m), by_objects);
  for (const ViewTie& tie : drive.ties) {
    const auto height = [&](int frame) {
      return drive.frames[frame].T_input_cam.translation().dot(GravityFrame{}.up) +
             correction.rise_m[frame];
    };
    EXPECT_NEAR(height(tie.from), height(tie.to), 0.05);
  }
}

// The old camera's tilt turns a loop's translation; the estimate knows it.
TEST(HeightsByLoops, AreMeasuredInTheWorld) {
  OutAndBack drive(0, 0);
  for (int i = 0; i < drive.frames.size(); ++i) {
    const Pose tilt(lie::SO3<double>::RotX(0.2), Vec3::Zero());
    drive.frames.SetPose(i, drive.frames[i].T_world_cam * tilt);
  }
  for (LoopAttempt& attempt : drive.loops.attempts())
    attempt.row().T_match_query = Pose(lie::SO3<double>::RotX(-0.2), Vec3::Zero()) *
                                  (Pose::Trans(0, 0, 4) * attempt.row().T_match_query);
  EXPECT_LT(drive.Rms(drive.Correct().rise_m), 1e-6);
}

// The ends of the drive, before the first and after the last measured frame, have the heights of
// these, since nothing tells of a drift there.
TEST(HeightsByLoops, EndsFollowTheNearestMeasurement) {
  OutAndBack drive(0.1, 0.1);
  LoopAttempt& loop = drive.loops.attempts().back();
  loop.found.loop.match = 1;
  loop.found.loop.query = drive.frames.size() - 2;
  const std::vector<double> rise_m = drive.Correct().rise_m;
  EXPECT_GT(std::abs(rise_m[5] - rise_m[1]), 1e-3);
  EXPECT_NEAR(rise_m[0], rise_m[1], 1e-9);
  EXPECT_NEAR(rise_m.back(), rise_m[rise_m.size() - 2], 1e-9);
}

// Between measured frames heights may be off by more than at these, however few there are.
TEST(HeightsByLoops, MeasurementsThatSayNothingChangeNothing) {
  OutAndBack drive(0.1, 0.1);
  std::vector<LoopAttempt>& attempts = drive.loops.attempts();
  for (std::size_t i = 0; i < attempts.size(); ++i)
    if (i % 9 != 0) attempts[i].row().decision = LoopDecision::kAmbiguous;
  const HeightCorrection few = drive.Correct();
  for (int frame = 5; frame + 10 < drive.frames.size(); frame += 10) {
    Vec6 variances;
    variances << Vec3::Constant(1e8), Vec3::Constant(1);
    drive.ties.push_back({frame, frame + 10, {Pose(), variances.asDiagonal()}});
  }
  const HeightCorrection many = drive.Correct();
  EXPECT_NEAR(few.probability, many.probability, 1e-4) << few.probability;
  for (std::size_t i = 0; i < few.rise_m.size(); ++i)
    EXPECT_NEAR(few.rise_m[i], many.rise_m[i], 1e-3) << i;
}

// The way back is a sequence of its own, whose odometry starts `higher` by some metres.
void CutWhereItTurns(double higher, OutAndBack& drive) {
  FrameStore frames(100);
  for (int i = 0; i < 2 * kOneWay; ++i) {
    FrameRecord record = drive.frames[i];
    if (i >= kOneWay) record.T_input_cam.translation() += higher * GravityFrame{}.up;
    frames.Append(record, StepUncertainty{i == kOneWay});
  }
  drive.frames = std::move(frames);
}

TEST(HeightsByLoops, FindTheHeightOfAnotherSequence) {
  OutAndBack drive(0.1, 0.1);
  const double uncut = drive.Rms(drive.Correct().rise_m);
  CutWhereItTurns(50, drive);
  EXPECT_LT(drive.Rms(drive.Correct().rise_m), 1.5 * uncut);
}

TEST(HeightsByLoops, PlacingASequenceIsNoImprovement) {
  OutAndBack drive(0, 0.2);
  CutWhereItTurns(50, drive);
  EXPECT_LT(drive.Correct().probability, 0.975);
}

}  // namespace
}  // namespace sslcd
