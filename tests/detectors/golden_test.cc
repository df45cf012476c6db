// SPDX-License-Identifier: BSD-3-Clause
// For each layout a tiny model, whose answers scripts/make_test_models.py has computed in its own
// way.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "../inference/test_models.h"
#include "formats/text_rows.h"
#include "sslcd/detectors/detector_2d.h"
#include "sslcd/detectors/detector_3d.h"
#include "sslcd/detectors/embedder.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

constexpr double kTolerance = 1e-4;

/// 64 x 48, the first 16 rows in another colour.
cv::Mat LeftImage() {
  cv::Mat image(48, 64, CV_8UC3, cv::Scalar(30, 90, 210));
  image.rowRange(0, 16).setTo(cv::Scalar(200, 10, 60));
  return image;
}

void ExpectNumbers(const TextRows& rows, std::size_t first, const std::vector<double>& values) {
  ASSERT_EQ(rows.size(), first + values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], rows.Number(first + i), kTolerance)
        << "column " << first + i << " of " << ToString(rows.where());
}

class Golden2d : public testing::TestWithParam<const char*> {};

TEST_P(Golden2d, FindsWhatNumPyFinds) {
  SSLCD_RUNTIME();
  const std::string name = GetParam();
  const Detector2d detector = Detector2d::Load(TestModel(name + ".yaml"));
  const cv::Mat image = LeftImage();
  const std::vector<ImageDetection> found = detector.Detect(ViewOf(image));
  TextRows rows(TestModel(name + ".txt"));
  std::size_t count = 0;
  for (; rows.Next(); ++count) {
    ASSERT_LT(count, found.size());
    const ImageDetection& detection = found[count];
    EXPECT_EQ(detection.label, rows.Text(0));
    const Box2d& box = detection.box;
    ExpectNumbers(rows, 1, {detection.score, box.left, box.top, box.right, box.bottom});
  }
  EXPECT_EQ(count, found.size());
}

INSTANTIATE_TEST_SUITE_P(, Golden2d,
                         testing::Values("yolo_v5", "yolox", "yolo_v8", "yolo_v10",
                                         "boxes_scores_labels", "fastestdet"),
                         [](const auto& test) { return std::string(test.param); });

class Golden3d : public testing::TestWithParam<const char*> {};

TEST_P(Golden3d, FindsWhatNumPyFinds) {
  SSLCD_RUNTIME();
  const std::string name = GetParam();
  const Detector3d detector = Detector3d::Load(TestModel(name + ".yaml"));
  EXPECT_EQ(detector.uses_right_image(), name == "stereo3d");
  const cv::Mat left = LeftImage(), right(48, 64, CV_8UC3, cv::Scalar(60, 120, 150));
  StereoCamera camera;
  camera.left.fx = 70;
  camera.left.fy = 72;
  camera.left.cx = 31;
  camera.left.cy = 20;
  camera.left.offset = {0.06, -0.01, 0.002};
  camera.baseline_m = 0.5;
  const std::vector<Detection> found = detector.Detect(
      {ViewOf(left), detector.uses_right_image() ? ViewOf(right) : ImageView()}, camera);
  TextRows rows(TestModel(name + ".txt"));
  std::size_t count = 0;
  for (; rows.Next(); ++count) {
    ASSERT_LT(count, found.size());
    const Detection& detection = found[count];
    EXPECT_EQ(detection.label, rows.Text(0));
    const Vec3 centre = detection.T_cam_object.translation();
    const double turn = -GravityFrame().YawOf(detection.T_cam_object.rotation());
    const double same_turn = rows.Number(8) + WrapAngle(turn - rows.Number(8));
    ASSERT_TRUE(detection.box);
    const Box2d& box = *detection.box;
    ExpectNumbers(rows, 1,
                  {detection.score, centre.x(), centre.y(), centre.z(), detection.dims.x(),
                   detection.dims.y(), detection.dims.z(), same_turn, box.left, box.top, box.right,
                   box.bottom});
  }
  EXPECT_EQ(count, found.size());
}

INSTANTIATE_TEST_SUITE_P(, Golden3d,
                         testing::Values("stereo3d", "mono3d", "monoflex", "monoflex_4"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Golden, Embeddings) {
  SSLCD_RUNTIME();
  const Embedder embedder = Embedder::Load(TestModel("embedding.yaml"));
  EXPECT_EQ(embedder.dimension(), 5);
  EXPECT_EQ(embedder.name(), "embedding");
  const cv::Mat image = LeftImage();
  TimingTable timing;
  const std::vector<Box2d> boxes = {
      {5, 20, 30, 44}, {10, 70, 20, 80}, {-9, -5, 40.5, 12}, {3, 3, 3, 9}};
  const auto found = embedder.Embed(ViewOf(image), boxes, &timing);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_TRUE(found[1].empty()) << "it lies under the image";
  EXPECT_TRUE(found[3].empty()) << "it has no width";
  TextRows rows(TestModel("embedding.txt"));
  for (const std::size_t i : {0, 2}) {
    ASSERT_TRUE(rows.Next());
    ExpectNumbers(rows, 0, {found[i].begin(), found[i].end()});
  }
  EXPECT_EQ(timing.Summary().at("embedding run").count, 1) << "both at once";
  EXPECT_TRUE(embedder.Embed(ViewOf(image), {}).empty());
  EXPECT_EQ(embedder.Embed(ViewOf(image), std::vector<Box2d>(70, boxes[0])).back(), found[0])
      << "in several batches";

  const Embedder in_pairs = Embedder::Load(TestModel("embedding_pairs.yaml"));
  EXPECT_EQ(in_pairs.Embed(ViewOf(image), {boxes[0], boxes[2], boxes[0]}),
            (std::vector<std::vector<float>>{found[0], found[2], found[0]}));
}

}  // namespace
}  // namespace sslcd
