// SPDX-License-Identifier: BSD-3-Clause
#include "render/write_images.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>

#include "sslcd/core/error.h"
#include "temp_folder.h"

namespace sslcd::render {
namespace {

sim::HalvWorld TinyWorld(int frames) {
  sim::HalvScene scene;
  scene.case_number = 4;
  scene.render_scale = 0.125;
  sim::HalvWorld world = sim::MakeHalvWorld(5, scene);
  world.world.truth.poses.resize(frames);
  world.world.truth.stamps.resize(frames);
  return world;
}

std::string Bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(WriteImages, SameBytesForAnyThreadCountAndTruthAsRendered) {
  TempFolder one, two;
  const Renderer renderer(TinyWorld(5), 1);
  int last = 0;
  WriteImages(renderer, one.path(), {true, 1, [&](int done, int frames) {
                                       EXPECT_EQ(done, ++last);
                                       EXPECT_EQ(frames, 5);
                                     }});
  EXPECT_EQ(last, 5);
  WriteImages(renderer, two.path(), {true, 2, nullptr});
  for (const char* folder :
       {"image_2", "image_3", "depth_2", "depth_3", "instance_2", "instance_3"}) {
    for (int frame = 0; frame < 5; ++frame) {
      const std::string name =
          std::string("/") + folder + "/00000" + std::to_string(frame) + ".png";
      EXPECT_TRUE(Bytes(one.path() + name) == Bytes(two.path() + name)) << name;
    }
  }
  const View view = renderer.Render(3, Side::kRight);
  const auto read = [&](const char* name) {
    return cv::imread(one.path() + name, cv::IMREAD_UNCHANGED);
  };
  const cv::Mat image = read("/image_3/000003.png"), depth = read("/depth_3/000003.png"),
                instance = read("/instance_3/000003.png");
  ASSERT_EQ(image.type(), CV_8UC3);
  ASSERT_EQ(depth.type(), CV_16U);
  ASSERT_EQ(instance.type(), CV_16U);
  EXPECT_TRUE(std::equal(view.bgr.begin(), view.bgr.end(), image.data));
  for (std::size_t i = 0; i < view.depth.size(); ++i) {
    const double expected = view.depth[i] < 255.99f ? view.depth[i] : 0;
    EXPECT_NEAR(depth.ptr<std::uint16_t>()[i] / kDepthUnitsPerMetre, expected,
                0.501 / kDepthUnitsPerMetre);
    EXPECT_EQ(instance.ptr<std::uint16_t>()[i], view.identity[i] + 1);
  }
}

TEST(WriteImages, LeavesNoImagesOfAnotherWorldAndNothingElseGoes) {
  TempFolder folder;
  for (const char* name : {"depth_2/000000.png", "image_2/000007.png", "image_2/notes.txt"})
    folder.Write(name, "old");
  WriteImages(Renderer(TinyWorld(1), 1), folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/image_2/000000.png"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/image_2/000007.png"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/depth_2/000000.png"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/image_2/notes.txt"));
}

TEST(WriteImages, BadCallsAreErrors) {
  TempFolder folder;
  const Renderer renderer(TinyWorld(2), 1);
  EXPECT_THROW(WriteImages(renderer, folder.path(), {false, 0, nullptr}), Error);
  std::ofstream(folder.path() + "/file") << "no folder";
  EXPECT_THROW(WriteImages(renderer, folder.path() + "/file"), std::exception);
}

}  // namespace
}  // namespace sslcd::render
