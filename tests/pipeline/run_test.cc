// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/frame_store.h"
#include "formats/g2o.h"
#include "formats/map_json.h"
#include "sim/sensor.h"
#include "sim/world.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"
#include "sslcd/formats/poses.h"

namespace sslcd {
namespace {

struct Scene {
  sim::World world;
  std::vector<Frame> frames;
  MapperContext context;
  sim::SimulatedDetections detections;
};

Scene Street(std::uint64_t seed, double detector_scale = 1., int frames = 200) {
  Scene scene;
  sim::StreetOptions street;
  street.frames = frames;
  scene.world = sim::MakeStreet(seed, street);
  sim::DetectorNoise noise;
  noise.scale = detector_scale;
  scene.detections = sim::SimulateDetections(scene.world, noise, seed);
  scene.frames =
      sim::MakeFrames(sim::SimulateOdometry(scene.world.truth, {}, seed), scene.detections);
  scene.context = {scene.world.gravity, scene.world.labels, scene.world.camera};
  return scene;
}

double Ate(const Trajectory& trajectory, const sim::World& world) {
  return ComputeAte(trajectory.poses, world.truth.poses).error.rmse;
}

TEST(RunSequence, FindsTheScaleAndTheParkedCars) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Scene scene = Street(seed);
    const RunResult result = RunSequence(scene.frames, scene.context, {});
    EXPECT_NEAR(result.scale, 1 / 1.03, 0.006) << "seed " << seed;
    EXPECT_LT(Ate(result.trajectory, scene.world), 0.5 * Ate(result.odometry, scene.world))
        << "seed " << seed;

    int confirmed = 0, mixed = 0, driving = 0;
    for (const MapObject& object : result.objects) {
      if (object.state != LandmarkState::kConfirmed) continue;
      ++confirmed;
      std::map<int, int> owners;
      for (const Observation& o : object.observations)
        ++owners[scene.detections.identity[o.detection_row]];
      mixed += owners.size() > 1;
      for (const auto& [id, count] : owners)
        driving += id >= 0 && scene.world.objects[id].driving();
    }
    EXPECT_GT(confirmed, 15) << "seed " << seed;
    EXPECT_LE(mixed, confirmed / 5) << "seed " << seed;
    EXPECT_EQ(driving, 0) << "seed " << seed;
  }
}

TEST(RunSequence, ANoisyDetectorStillHelpsAndTheOnlineMapWorksAlone) {
  const Scene scene = Street(5, 5.);
  Options options;
  options.refine.enabled = false;
  for (const bool refine : {false, true}) {
    options.refine.enabled = refine;
    const RunResult result = RunSequence(scene.frames, scene.context, options);
    EXPECT_LT(Ate(result.trajectory, scene.world), 0.7 * Ate(result.odometry, scene.world))
        << "refine " << refine;
    EXPECT_GT(result.noise_scale.radial, 1.5);
  }
}

TEST(RunSequence, WithoutObjectsTheTrajectoryIsTheOdometry) {
  Scene scene = Street(1);
  for (Frame& frame : scene.frames) frame.detections.clear();
  const RunResult result = RunSequence(scene.frames, scene.context, {});
  EXPECT_TRUE(result.objects.empty());
  EXPECT_EQ(result.scale, 1.);
  EXPECT_NEAR(Ate(result.trajectory, scene.world), Ate(result.odometry, scene.world), 1e-9);
}

TEST(RunSequence, DrivingCarsAloneDoNoHarm) {
  Scene scene = Street(2);
  for (Frame& frame : scene.frames) {
    auto& list = frame.detections;
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&](const Detection& d) {
                                const int id = scene.detections.identity[d.row];
                                return id < 0 || !scene.world.objects[id].driving();
                              }),
               list.end());
  }
  const RunResult result = RunSequence(scene.frames, scene.context, {});
  EXPECT_LE(Ate(result.trajectory, scene.world), 1.02 * Ate(result.odometry, scene.world));
}

TEST(RunSequence, RepeatsToTheByte) {
  const Scene scene = Street(4, 2., 120);
  const auto bytes = [&] {
    const RunResult result = RunSequence(scene.frames, scene.context, {});
    return TumText(result.trajectory) + MapJson({scene.world.gravity.up, result.objects}) +
           G2oText(result.graph);
  };
  EXPECT_EQ(bytes(), bytes());
}

std::string Bytes(const RunResult& result) {
  return TumText(result.trajectory) + TumText(result.odometry) +
         MapJson({Vec3(0, -1, 0), result.objects}) + G2oText(result.graph);
}

TEST(RunSequence, FramesThatComeOneByOneAreTheSame) {
  const Scene scene = Street(4, 2., 120);
  std::size_t next = 0;
  int last_total = 0;
  RunHooks hooks;
  hooks.progress = [&](int done, int total) {
    EXPECT_EQ(done, static_cast<int>(next)) << "a frame is asked for when it is needed, no sooner";
    last_total = total;
  };
  const FrameSource source = [&]() -> std::optional<Frame> {
    return next < scene.frames.size() ? std::optional<Frame>(scene.frames[next++]) : std::nullopt;
  };
  const RunResult streamed = RunSequence(source, 7, scene.context, {}, hooks);
  const RunResult stored = RunSequence(scene.frames, scene.context, {});
  EXPECT_EQ(Bytes(streamed), Bytes(stored));
  EXPECT_EQ(streamed.frames, stored.frames);
  EXPECT_FALSE(streamed.objects.empty());
  EXPECT_FALSE(streamed.stopped);
  EXPECT_EQ(last_total, 7);
}

TEST(RunSequence, AStopInTheMiddleOfASourceKeepsWhatThereIs) {
  const Scene scene = Street(1, 1., 60);
  std::size_t asked = 0;
  RunHooks hooks;
  hooks.stop = [&] { return asked == 25; };
  const RunResult result = RunSequence([&] { return std::optional<Frame>(scene.frames[asked++]); },
                                       60, scene.context, {}, hooks);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(asked, 25u) << "no frame is taken and left";
  EXPECT_EQ(result.frames.size(), 25u);
  const std::vector<Frame> first(scene.frames.begin(), scene.frames.begin() + 25);
  EXPECT_EQ(Bytes(result), Bytes(RunSequence(first, scene.context, {})));
}

TEST(RunSequence, ASourceMayBeEmptyOrThrow) {
  const Scene scene = Street(1, 1., 10);
  const RunResult nothing =
      RunSequence([] { return std::optional<Frame>(); }, 0, scene.context, {});
  EXPECT_TRUE(nothing.frames.empty());
  EXPECT_TRUE(nothing.objects.empty());
  EXPECT_FALSE(nothing.stopped);
  int asked = 0;
  const FrameSource broken = [&]() -> std::optional<Frame> {
    if (asked == 3) throw Error(ErrorKind::kBadInput, "the camera is gone");
    return scene.frames[asked++];
  };
  EXPECT_THROW(RunSequence(broken, 10, scene.context, {}), Error);
}

TEST(RunSequence, PaperModeRuns) {
  const Scene scene = Street(1, 1., 100);
  const RunResult result = RunSequence(scene.frames, scene.context, DefaultOptions(Mode::kPaper));
  EXPECT_EQ(result.scale, 1.) << "the paper has no scale";
  EXPECT_EQ(result.trajectory.size(), 100u);
  EXPECT_TRUE(std::isfinite(Ate(result.trajectory, scene.world)));
}

TEST(RunSequence, StopsWhenAsked) {
  const Scene scene = Street(1, 1., 60);
  RunHooks hooks;
  int seen = 0;
  hooks.progress = [&](int done, int total) {
    EXPECT_EQ(total, 60);
    seen = done;
  };
  hooks.stop = [&] { return seen == 25; };
  const RunResult result = RunSequence(scene.frames, scene.context, {}, hooks);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.trajectory.size(), 25u);
  EXPECT_EQ(result.frames.back(), 24);
}

TEST(Mapper, RefusesBadFramesAndStaysAsItWas) {
  const Scene scene = Street(1, 1., 10);
  Mapper mapper({}, scene.context);
  for (int i = 0; i < 3; ++i) mapper.AddFrame(scene.frames[i]);
  EXPECT_THROW(mapper.AddFrame(scene.frames[2]), Error) << "the same stamp again";
  Frame nan = scene.frames[3];
  nan.T_odom_cam.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(mapper.AddFrame(nan), Error);
  EXPECT_EQ(mapper.CameraTrajectory().size(), 3u);
  EXPECT_NO_THROW(mapper.AddFrame(scene.frames[3]));
}

TEST(Mapper, RefineMayBeCalledAnyTime) {
  const Scene scene = Street(3, 1., 120);
  Mapper mapper({}, scene.context);
  EXPECT_FALSE(mapper.Refine().usable) << "nothing seen yet";
  for (int i = 0; i < 120; ++i) {
    mapper.AddFrame(scene.frames[i]);
    if (i == 60) {
      EXPECT_TRUE(mapper.Refine().usable);
    }
  }
  mapper.Refine();
  mapper.Refine();
  EXPECT_NEAR(mapper.scale(), 1 / 1.03, 0.01);
  EXPECT_EQ(mapper.CameraTrajectory().size(), 120u);
}

}  // namespace
}  // namespace sslcd
