// SPDX-License-Identifier: BSD-3-Clause
#include "report/draw_run.h"

#include <cmath>

#include "datasets/run_folder.h"
#include "report/ground_plan.h"
#include "sslcd/formats/poses.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::HasSubstr;
using testing::Not;

// The same world under another up axis: three poses ahead, and a car and a tree to the right.
RunOutputs World(const Vec3& up) {
  const GravityFrame gravity = GravityFrame::FromUp(up);
  const auto at = [&](double right, double ahead) -> Vec3 {
    return gravity.forward * right + gravity.left * ahead;
  };
  RunOutputs run;
  for (int i = 0; i < 3; ++i) {
    run.trajectory.stamps.push_back(i);
    run.trajectory.poses.emplace_back(lie::SO3<double>(), at(0, 10 * i));
  }
  run.odometry = run.trajectory;
  run.map.up_axis = up;
  for (const auto& [id, label, right] : {std::tuple{1, "Car", 5.}, std::tuple{2, "Tree<", 9.}}) {
    MapObject object;
    object.id.value = id;
    object.label = label;
    object.state = LandmarkState::kConfirmed;
    object.T_world_object = Pose(gravity.Upright(0), at(right, 10));
    object.dims = Vec3(4, 2, 1.5);
    run.map.objects.push_back(object);
  }
  run.record.labels.Set("Tree<", {Symmetry::kFull});
  LoopClosure loop;
  loop.query_frame = 2;
  loop.decision = LoopDecision::kAccepted;
  loop.viewpoint_change_rad = 170.2 * M_PI / 180;
  loop.pairs = {{{7}, {2}}};
  run.loops = {loop, LoopClosure()};
  return run;
}

std::string Svg(const RunOutputs& outputs, const DrawOptions& options = {}) {
  const TempFolder folder;
  WriteRunFolder(folder.path(), outputs);
  return SvgText(DrawRun(ReadRun(folder.path()), options));
}

std::size_t Count(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

TEST(DrawRun, ThePageDoesNotDependOnTheUpAxis) {
  const std::string picture = Svg(World(Vec3(0, -1, 0)));
  EXPECT_EQ(Svg(World(Vec3(0, 0, 1))), picture);
  EXPECT_EQ(Svg(World(Vec3(1, 0, 0))), picture);
}

TEST(DrawRun, SeenFromAboveAndNotMirrored) {
  const GravityFrame kitti = GravityFrame::FromUp(Vec3(0, -1, 0));
  EXPECT_EQ(FromAbove(Vec3(1, 2, 3), kitti), Vec2(1, 3));  // right and ahead
  const GroundPlan wide({Vec2(0, 0), Vec2(40, 10)}, 560), high({Vec2(0, 0), Vec2(10, 40)}, 560);
  EXPECT_EQ(wide.scale(), 10);
  EXPECT_EQ(wide(Vec2(0, 0)), Vec2(80, 180));  // a margin of 8 m
  for (const GroundPlan& plan : {wide, high}) {
    const Vec2 o = plan(Vec2(0, 0)), x = plan(Vec2(1, 0)) - o, y = plan(Vec2(0, 1)) - o;
    EXPECT_LT(x.x() * y.y() - x.y() * y.x(), 0) << "y of the page is down";
  }
}

TEST(DrawRun, RoundObjectsLoopsAndLegend) {
  const std::string picture = Svg(World(Vec3(0, -1, 0)));
  EXPECT_EQ(Count(picture, "<circle"), 3u);  // a tree, both ends of a loop
  EXPECT_THAT(picture, HasSubstr(">1 loop, viewpoint change"));
  EXPECT_THAT(picture, HasSubstr(Hex(ViewpointColour(170.2 * M_PI / 180))));
  EXPECT_THAT(picture, HasSubstr(">Tree&lt;</text>"));
  EXPECT_THAT(picture, HasSubstr(" m</text>"));
  EXPECT_THAT(picture, Not(HasSubstr("ground truth")));
  DrawOptions none;
  none.max_loops = 0;
  EXPECT_EQ(Count(Svg(World(Vec3(0, -1, 0)), none), "<circle"), 1u);
  DrawOptions both;
  both.before_after = true;
  EXPECT_EQ(Count(Svg(World(Vec3(0, -1, 0)), both), "<circle"), 5u);
}

TEST(DrawRun, OneLoopWithItsMatchedObjects) {
  DrawOptions options;
  options.loop = 2;
  const std::string picture = Svg(World(Vec3(0, 0, 1)), options);
  EXPECT_THAT(picture, HasSubstr("1 object matched from directions 170 degrees apart"));
  EXPECT_EQ(Count(picture, "fill=\"" + Hex(kMatchedColour) + "\""), 2u);  // and in the legend
  options.loop = 0;                                                       // refused
  EXPECT_THAT([&] { Svg(World(Vec3(0, 0, 1)), options); },
              testing::ThrowsMessage<Error>(HasSubstr("no accepted loop")));
}

TEST(DrawRun, TruthIsAlignedRigidly) {
  RunOutputs run = World(Vec3(0, 0, 1));
  run.trajectory.poses[2] = run.odometry.poses[2] = Pose::Trans(7, 20, 0);  // not on one line
  run.groundtruth = run.trajectory;
  const Pose moved =
      Pose::Trans(3, 70, 1) * Pose(lie::SO3<double>::Exp(Vec3(0, 0, 1.5)), Vec3(0, 0, 0));
  for (Pose& pose : run.groundtruth.poses) pose = moved * pose;
  const TempFolder folder;
  WriteRunFolder(folder.path(), run);
  const RunView view = ReadRun(folder.path());
  ASSERT_EQ(view.truth.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((view.truth.poses[i].translation() - run.trajectory.poses[i].translation()).norm(),
              1e-6);
  EXPECT_THAT(SvgText(DrawRun(view)), HasSubstr("ground truth"));
}

TEST(DrawRun, RunsThatCannotBeDrawn) {
  EXPECT_THROW(Svg(RunOutputs()), Error);
  EXPECT_THROW(ReadRun("nowhere"), Error);
  const TempFolder folder;
  WriteRunFolder(folder.path(), World(Vec3(0, 0, 1)));
  folder.Write("loops.csv", "a,b\n");
  EXPECT_THROW(ReadRun(folder.path()), Error);
}

}  // namespace
}  // namespace sslcd
