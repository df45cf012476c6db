// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/model.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "../inference/test_models.h"
#include "../support/temp_folder.h"
#include "formats/text_rows.h"
#include "sslcd/detectors/detector_2d.h"
#include "sslcd/detectors/embedder.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

/// Loading a test model with another description than its own fails, and the message has all
/// `parts`.
void ExpectRefused(const std::string& model, const std::string& yaml,
                   const std::vector<std::string>& parts) {
  const TempFolder folder;
  const std::string path = folder.Write("m.yaml", "file: " + TestModel(model) + "\n" + yaml);
  ExpectError([&] { Detector2d::Load(path); }, parts);
}

const std::string kThree = "output: {layout: yolo_v5, class_count: 3, labels: {0: Car}}\n";

TEST(Model, InputsThatDoNotFit) {
  SSLCD_RUNTIME();
  ExpectRefused(
      "yolo_v5.onnx", "input: {width_px: 640, height_px: 480}\n" + kThree,
      {"m.yaml", "input 'images' of the model is 1x3x48x64, the description has ?x3x480x640",
       "yolo_v5.onnx"});
  ExpectRefused("yolo_v5.onnx", "input: {left: pixels}\n" + kThree,
                {"no input 'pixels', only 'images'"});
  ExpectRefused("boxes_scores_labels.onnx", kThree,
                {"the model has 2 inputs, the description fills 1"});
}

TEST(Model, OutputsThatDoNotFit) {
  SSLCD_RUNTIME();
  ExpectRefused("yolo_v5.onnx", "output: {layout: yolo_v5, labels: {0: Car}}\n",
                {"output 'output0' of the model is 1x5x8, the layout expects 1x?x85"});
  ExpectRefused("yolo_v5.onnx", "output: {layout: fastestdet, labels: {0: Car}}\n",
                {"1x5x8", "1x85x?x?"});
  ExpectRefused("yolo_v5.onnx", "output: {layout: boxes_scores_labels, labels: {0: Car}}\n",
                {"1x5x8", "1x?x4"});
  ExpectRefused("boxes_scores_labels.onnx",
                "input: {size: sizes}\noutput: {layout: boxes_scores_labels, names: {0: bxs}, "
                "labels: {0: Car}}\n",
                {"no output 'bxs', only 'labels', 'unused'"});
}

TEST(Model, FilesThatAreNotThere) {
  SSLCD_RUNTIME();
  const TempFolder folder;
  const std::string path = folder.Write("m.yaml", "file: none.onnx\n" + kThree);
  ExpectError([&] { Detector2d::Load(path); }, {folder.path() + "/none.onnx", "cannot be read"});
  ExpectError([] { Embedder::Load(TestModel("yolo_v5.yaml")); },
              {"yolo_v5.yaml", "for Detector2d, not for Embedder"});
  ExpectError([] { Detector2d::Load(TestModel("embedding.yaml")); },
              {"for Embedder, not for Detector2d"});
}

TEST(Model, RefusesGreyImages) {
  SSLCD_RUNTIME();
  const cv::Mat grey(48, 64, CV_8UC1, cv::Scalar(1));
  const Detector2d detector = Detector2d::Load(TestModel("yolo_v5.yaml"));
  ExpectError([&] { detector.Detect(ViewOf(grey)); }, {"grey", "needs colour"});
  ExpectError([&] { detector.Detect({}); }, {"empty"});
  const Embedder embedder = Embedder::Load(TestModel("embedding.yaml"));
  ExpectError([&] { embedder.Embed(ViewOf(grey), {{0, 0, 9, 9}}); }, {"grey", "needs colour"});
}

TEST(Model, TakesTimesOfItsStages) {
  SSLCD_RUNTIME();
  const Detector2d detector = Detector2d::Load(TestModel("yolo_v5.yaml"));
  const cv::Mat image(48, 64, CV_8UC3, cv::Scalar::all(9));
  TimingTable timing;
  detector.Detect(ViewOf(image), &timing);
  detector.Detect(ViewOf(image), &timing);
  for (const char* stage : {"yolo_v5 prepare", "yolo_v5 run", "yolo_v5 decode"})
    EXPECT_EQ(timing.Summary()[stage].count, 2) << stage;
}

}  // namespace
}  // namespace sslcd
