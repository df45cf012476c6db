// SPDX-License-Identifier: BSD-3-Clause
#include "render/renderer.h"

#include <gmock/gmock.h>

#include <cmath>

#include "perception/projection.h"
#include "sslcd/core/error.h"

namespace sslcd::render {
namespace {

sim::HalvWorld SmallWorld(double scale = 0.25) {
  sim::HalvScene scene;
  scene.case_number = 4;
  scene.render_scale = scale;
  return sim::MakeHalvWorld(5, scene);
}

/// One object and nothing else; the camera looks along z from 1.2 m above the ground.
sim::HalvWorld OneObject(const char* label, const Vec3& dims, double ahead, double yaw = 0) {
  sim::HalvWorld scene = SmallWorld();
  scene.spaces.clear();
  scene.world.objects.resize(1);
  sim::WorldObject& object = scene.world.objects[0];
  object = {};
  object.label = label;
  object.dims = dims;
  object.T_world_object = {Pose(scene.world.gravity.Upright(yaw),
                                Vec3(0, scene.world.camera_height_m - 0.5 * dims.z(), ahead))};
  return scene;
}

double Brightness(const View& view) {
  double sum = 0;
  for (std::uint8_t byte : view.bgr) sum += byte;
  return sum / static_cast<double>(view.bgr.size());
}

TEST(Renderer, DepthOfTheGroundIsThatOfThePlane) {
  const sim::HalvWorld scene = OneObject("Car", {4, 1.8, 1.5}, 300);
  const View view = Renderer(scene, 1).Render(0, Side::kLeft);
  const Camera& camera = scene.world.camera;
  for (int y : {120, 150, 179}) {
    for (int x : {10, 160, 300}) {
      EXPECT_NEAR(view.depth[view.PixelAt(x, y)],
                  scene.world.camera_height_m * camera.fy / (y - camera.cy), 1e-3);
      EXPECT_EQ(view.identity[view.PixelAt(x, y)], -1);
    }
  }
  EXPECT_EQ(view.depth[view.PixelAt(160, 2)], 0) << "sky";
}

TEST(Renderer, DepthOfATrucksRearIsThatOfItsCuboid) {
  const Vec3 dims(5, 2, 2.6);
  // its rear towards the camera
  const sim::HalvWorld scene = OneObject("Truck", dims, 10, M_PI / 2);
  const View view = Renderer(scene, 1).Render(0, Side::kLeft);
  const Camera& camera = scene.world.camera;
  const double rear = 10 - 0.5 * dims.x();
  for (const Vec2& at : {Vec2(0, 0), Vec2(-0.8, -0.5), Vec2(0.8, 0.2)}) {  // right, down
    const int x = static_cast<int>(std::lround(camera.cx + camera.fx * at.x() / rear));
    const int y = static_cast<int>(std::lround(camera.cy + camera.fy * at.y() / rear));
    EXPECT_NEAR(view.depth[view.PixelAt(x, y)], rear, 1e-4);
    EXPECT_EQ(view.identity[view.PixelAt(x, y)], 0);
  }
}

TEST(Renderer, RightImageAgreesWithDepthAndBaseline) {
  const sim::HalvWorld scene = SmallWorld();
  const Renderer renderer(scene, 1);
  const View left = renderer.Render(20, Side::kLeft), right = renderer.Render(20, Side::kRight);
  int agree = 0, looked_at = 0;
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      const float depth = left.depth[left.PixelAt(x, y)];
      if (depth == 0) continue;
      const double to = x - scene.world.camera.fx * scene.world.baseline_m / depth;
      if (std::lround(to) < 0) continue;
      const std::size_t at = right.PixelAt(static_cast<int>(std::lround(to)), y);
      ++looked_at;
      agree += std::abs(right.depth[at] - depth) < 0.05 * depth &&
               right.identity[at] == left.identity[left.PixelAt(x, y)];
    }
  }
  EXPECT_GT(looked_at, left.width * left.height / 3);
  EXPECT_GT(agree, 0.93 * looked_at);  // the others are hidden from the right, or on an edge
}

TEST(Renderer, IdentitiesCoverTheProjectedBoxes) {
  const sim::HalvWorld scene = SmallWorld(0.5);
  const Renderer renderer(scene, 1);
  int boxes = 0;
  double sum = 0;
  for (int frame : {0, 30, 60, 90}) {
    const View view = renderer.Render(frame, Side::kLeft);
    std::vector<Box2d> seen(scene.world.objects.size(), {1e9, 1e9, -1, -1});
    std::vector<int> pixels(scene.world.objects.size(), 0);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const int id = view.identity[view.PixelAt(x, y)];
        if (id < 0) continue;
        EXPECT_TRUE(scene.world.objects[id].IsThereAt(frame));
        Box2d& box = seen[id];
        box = {std::min<double>(box.left, x), std::min<double>(box.top, y),
               std::max<double>(box.right, x), std::max<double>(box.bottom, y)};
        ++pixels[id];
      }
    }
    for (const sim::WorldObject& object : scene.world.objects) {
      if (object.label != "Car" && object.label != "Van") continue;
      const auto box =
          ProjectCuboid(scene.world.truth.poses[frame].inverse() * object.PoseAt(frame),
                        object.dims, scene.world.camera);
      // Nearly all of a vehicle's box is the vehicle where nothing hides it.
      if (!box || box->Area() < 900 || pixels[object.id] < 0.55 * box->Area()) continue;
      ++boxes;
      sum += Iou(*box, seen[object.id]);
      EXPECT_GT(Iou(*box, seen[object.id]), 0.6) << frame << " " << object.id;
    }
  }
  EXPECT_GT(boxes, 10);
  EXPECT_GT(sum / boxes, 0.8);  // round corners leave some of a box free
}

TEST(Renderer, DrivingAndChurnedVehiclesAreWhereTheWorldSays) {
  sim::HalvWorld scene = OneObject("Car", {4, 1.8, 1.5}, 6);
  sim::WorldObject& object = scene.world.objects[0];
  const std::size_t frames = scene.world.truth.size();
  scene.world.truth.poses.assign(frames, Pose());
  for (std::size_t i = 1; i < frames; ++i) {
    object.T_world_object.push_back(object.T_world_object[0]);
    object.T_world_object.back().translation().x() += 0.2 * static_cast<double>(i);
  }
  object.end_frame = 10;
  const Renderer renderer(scene, 1);
  const auto columns = [&](int frame) {
    const View view = renderer.Render(frame, Side::kLeft);
    double sum = 0;
    int count = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        if (view.identity[view.PixelAt(x, y)] == 0) {
          sum += x;
          ++count;
        }
      }
    }
    return count == 0 ? -1 : sum / count;
  };
  // at a depth of 1 m; the car's side is 5.1 m away
  const double moved = scene.world.camera.fx * 0.2 * 9;
  EXPECT_THAT(columns(9) - columns(0),
              testing::AllOf(testing::Gt(moved / 6.5), testing::Lt(moved / 5)));
  EXPECT_EQ(columns(10), -1) << "gone";
}

TEST(Renderer, SecondPassHasAnotherLight) {
  sim::HalvWorld scene = SmallWorld();
  scene.world.truth.poses.assign(scene.world.truth.size(), Pose());
  scene.world.objects.clear();
  const int back = scene.return_frame;
  RenderOptions options;
  const View before = Renderer(scene, 1).Render(back - 1, Side::kLeft),
             after = Renderer(scene, 1).Render(back, Side::kLeft);
  double difference = 0;
  for (std::size_t i = 0; i < before.bgr.size(); ++i)
    difference += std::abs(before.bgr[i] - after.bgr[i]);
  EXPECT_GT(difference / static_cast<double>(before.bgr.size()), 8);
  EXPECT_EQ(before.depth, after.depth);
  options.back = options.out;
  const Renderer same(scene, 1, options);
  EXPECT_NEAR(Brightness(same.Render(back - 1, Side::kLeft)),
              Brightness(same.Render(back, Side::kLeft)), 2);
}

TEST(Renderer, OptionsDoWhatTheySay) {
  const sim::HalvWorld scene = SmallWorld();
  RenderOptions options;
  const View view = Renderer(scene, 1, options).Render(0, Side::kLeft);
  options.out.exposure = 0.5;
  EXPECT_LT(Brightness(Renderer(scene, 1, options).Render(0, Side::kLeft)),
            0.85 * Brightness(view));
  options = {};
  options.noise = 0;
  const View clean = Renderer(scene, 1, options).Render(0, Side::kLeft);
  double squares = 0;
  for (std::size_t i = 0; i < view.bgr.size(); ++i)
    squares += std::pow(view.bgr[i] - clean.bgr[i], 2);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(view.bgr.size())), RenderOptions().noise,
              0.2);
  options.vignetting = 0.9;
  const View dark = Renderer(scene, 1, options).Render(0, Side::kLeft);
  EXPECT_LT(dark.bgr[0], 0.7 * clean.bgr[0]);
  const std::size_t middle = 3 * view.PixelAt(view.width / 2, view.height / 2);
  EXPECT_NEAR(dark.bgr[middle], clean.bgr[middle], 1);
}

TEST(Renderer, BadInputIsRefused) {
  RenderOptions options;
  options.vignetting = 2;
  options.out.exposure = NAN;
  try {
    Renderer(SmallWorld(), 1, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("vignetting"), testing::HasSubstr("exposure")));
  }
  sim::HalvWorld empty = SmallWorld();
  empty.world.truth = {};
  EXPECT_THROW(Renderer(empty, 1), Error);
  sim::HalvWorld no_size = SmallWorld();
  no_size.world.camera.width = 0;
  EXPECT_THROW(Renderer(no_size, 1), Error);
  const Renderer renderer(SmallWorld(), 1);
  EXPECT_THROW(renderer.Render(-1, Side::kLeft), Error);
  EXPECT_THROW(renderer.Render(renderer.frames(), Side::kLeft), Error);
}

}  // namespace
}  // namespace sslcd::render
