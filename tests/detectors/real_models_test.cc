// SPDX-License-Identifier: BSD-3-Clause
// FastestDet and OSNet on 20 real frames, in which a car comes towards the camera.
#include <gtest/gtest.h>

#include <numeric>
#include <opencv2/imgcodecs.hpp>

#include "../inference/test_models.h"
#include "../support/temp_folder.h"
#include "formats/text_rows.h"
#include "sslcd/detectors/detector_2d.h"
#include "sslcd/detectors/embedder.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

constexpr int kFirst = 3;
/// The car in frames 3 to 12, marked by hand to about 3 px. It is wholly visible in all of them (in
/// frame 12 its bumper touches the border) and, by its height in the image (1.45 m at 719 px),
/// nearer than 30 m from frame 5 on.
const std::vector<Box2d> kOncoming = {
    {457, 180, 498, 210}, {446, 180, 492, 212}, {432, 180, 484, 217}, {415, 180, 474, 221},
    {392, 181, 462, 228}, {364, 183, 447, 237}, {323, 183, 427, 249}, {264, 184, 400, 264},
    {169, 184, 359, 289}, {2, 186, 302, 327}};

cv::Mat Frame(const std::string& data, int number) {
  char name[32];
  std::snprintf(name, sizeof name, "/image_2/%06d.png", number);
  return cv::imread(data + name);
}

/// The shipped description of a model, beside the model in the data folder.
std::string Description(const TempFolder& folder, const std::string& name,
                        const std::string& models) {
  std::string text = ReadFileBytes(std::string(SSLCD_MODEL_CONFIGS) + "/" + name + ".yaml");
  text.replace(text.find("file: ") + 6, 0, models + "/");
  return folder.Write(name + ".yaml", text);
}

/// The car that overlaps a box most.
Box2d NearestCar(const Detector2d& detector, const cv::Mat& image, const Box2d& expected) {
  Box2d nearest;
  for (const ImageDetection& found : detector.Detect(ViewOf(image)))
    if (found.label == "Car" && Iou(found.box, expected) > Iou(nearest, expected))
      nearest = found.box;
  return nearest;
}

TEST(RealModels, TheOncomingCarIsFoundInEveryFrameAndKnownAgainInTheNext) {
  SSLCD_RUNTIME();
  SSLCD_REAL_DATA(models, "onnx");
  SSLCD_REAL_DATA(data, "kitti-stereo-color");
  const TempFolder folder;
  const Detector2d detector = Detector2d::Load(Description(folder, "fastestdet", models));
  const Embedder embedder = Embedder::Load(Description(folder, "osnet", models));
  EXPECT_EQ(embedder.dimension(), 512);
  std::vector<float> before;
  for (std::size_t i = 0; i < kOncoming.size(); ++i) {
    SCOPED_TRACE("frame " + std::to_string(kFirst + i));
    const cv::Mat image = Frame(data, kFirst + static_cast<int>(i));
    const Box2d box = NearestCar(detector, image, kOncoming[i]);
    EXPECT_GE(Iou(box, kOncoming[i]), 0.5);
    const std::vector<float> now = embedder.Embed(ViewOf(image), {box}).at(0);
    EXPECT_NEAR(std::inner_product(now.begin(), now.end(), now.begin(), 0.), 1, 1e-5);
    const double same =
        before.empty() ? 1 : std::inner_product(now.begin(), now.end(), before.begin(), 0.);
    EXPECT_GE(same, 0.7);
    before = now;
  }
}

TEST(RealModels, BoxesOfOneBatchAreThoseOfOneByOne) {
  SSLCD_RUNTIME();
  SSLCD_REAL_DATA(models, "onnx");
  SSLCD_REAL_DATA(data, "kitti-stereo-color");
  const TempFolder folder;
  const Embedder embedder = Embedder::Load(Description(folder, "osnet", models));
  const cv::Mat image = Frame(data, 9);
  const std::vector<Box2d> boxes = {kOncoming[6], {570, 170, 610, 200}, {100, 100, 180, 200}};
  const auto together = embedder.Embed(ViewOf(image), boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::vector<float> alone = embedder.Embed(ViewOf(image), {boxes[i]}).at(0);
    for (std::size_t k = 0; k < alone.size(); ++k) ASSERT_NEAR(together[i][k], alone[k], 1e-5);
  }
}

TEST(RealModels, SameBytesOnOneAndTwoThreads) {
  SSLCD_RUNTIME();
  SSLCD_REAL_DATA(models, "onnx");
  SSLCD_REAL_DATA(data, "kitti-stereo-color");
  const TempFolder folder;
  const std::string description = Description(folder, "osnet", models);
  InferenceOptions two;
  two.threads = 2;
  const cv::Mat image = Frame(data, 9);
  const std::vector<Box2d> boxes(kOncoming.begin(), kOncoming.begin() + 3);
  EXPECT_EQ(Embedder::Load(description).Embed(ViewOf(image), boxes),
            Embedder::Load(description, two).Embed(ViewOf(image), boxes));
}

}  // namespace
}  // namespace sslcd
