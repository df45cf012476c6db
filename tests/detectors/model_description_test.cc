// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/model_description.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "../support/temp_folder.h"

namespace sslcd {
namespace {

const char kGood[] =
    "file: a.onnx\noutput: {layout: yolo_v8, class_count: 3, labels: {0: Car, 2: Truck}}\n";

TEST(ModelDescription, ReadsAndFillsIn) {
  const TempFolder folder;
  const ModelDescription model = LoadModelDescription(folder.Write("sub/yolo.yaml", kGood));
  EXPECT_EQ(model.name, "yolo");
  EXPECT_EQ(model.file, folder.path() + "/sub/a.onnx");
  EXPECT_EQ(model.output.labels, (std::map<int, std::string>{{0, "Car"}, {2, "Truck"}}));
  EXPECT_EQ(model.output.anchors.scales.size(), 16u);
  EXPECT_DOUBLE_EQ(model.output.anchors.scales[4], 2);
  const ModelDescription absolute = LoadModelDescription(folder.Write(
      "b.yaml", std::string("name: mine\ninput: {mean: [1, 2, 3], resize: letterbox}\n") + kGood));
  EXPECT_EQ(absolute.name, "mine");
  EXPECT_EQ(absolute.input.mean, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(absolute.input.resize, ModelInput::Resize::kLetterbox);
  EXPECT_EQ(model.output.box_sigma, 0);
  const std::string coarse =
      "file: a.onnx\noutput: {layout: fastestdet, labels: {2: Car}, box_sigma: 0.1}\n";
  EXPECT_EQ(LoadModelDescription(folder.Write("c.yaml", coarse)).output.box_sigma, 0.1);
}

TEST(ModelDescription, ShippedOnesAreGood) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SSLCD_MODEL_CONFIGS)) {
    EXPECT_NO_THROW(LoadModelDescription(entry.path().string())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 8);
}

TEST(ModelDescription, IsStrict) {
  const TempFolder folder;
  const auto refuses = [&folder](const std::string& yaml, const std::vector<std::string>& parts) {
    const std::string path = folder.Write("m.yaml", yaml);
    ExpectError([&] { LoadModelDescription(path); }, parts);
  };
  refuses("file: a.onnx\ninput: {widht_px: 3}\n" + std::string(kGood + 13),
          {"m.yaml:2:9: unknown key 'widht_px' in 'input' - did you mean 'width_px'?"});
  ExpectError([] { LoadModelDescription("some/yolo11s.onnx"); },
              {"some/yolo11s.onnx: is a model",
               "sslcd_run model inspect some/yolo11s.onnx --out yolo11s.yaml"});
  refuses("output: {labels: {0: Car}}\n", {"'file' is missing"});
  refuses("file: a.onnx\n", {"'labels' in 'output' is missing", "{2: Car}"});
  refuses("file: a.onnx\noutput: {class_count: 2, labels: {2: Car}}\n",
          {"class 2", "'class_count' is 2"});
  for (const char* label : {"Big Car", "''", "'Car,'", "'\tCar'"})
    refuses("file: a.onnx\noutput: {labels: {0: " + std::string(label) + "}}\n",
            {"class 0", "one word"});
  refuses("file: a.onnx\noutput: {labels: {car: Car}}\n",
          {"m.yaml:2:19", "'labels' has 'car'", "whole number"});
  refuses("file: a.onnx\noutput: {labels: [Car]}\n",
          {"'labels' is a list or map, must be names by number"});
  refuses("file: a.onnx\ninput: {std: [1, 0, 1]}\n", {"m.yaml:2:18: 'std' is 0, must be in"});
  refuses("file: a.onnx\ninput: {mean: [1, two]}\n",
          {"'mean' is 'two', must be a list of numbers"});
  refuses("file: a.onnx\ninput: {mean: [1, 2]}\n", {"three numbers"});
  refuses("file: a.onnx\noutput: {layout: stereo3d, class_count: 1, labels: {0: Car}}\n",
          {"'mean_files'", "class 0"});
  refuses("file: a.onnx\noutput: {labels: {0: Car}, box_sigma: -0.1}\n",
          {"'box_sigma' is -0.1, must be in"});
  refuses("file: a.onnx\noutput: {layout: yolo_v9}\n",
          {"'layout' is 'yolo_v9', must be one of yolo_v5"});
  ExpectError([] { LoadModelDescription("/nowhere/m.yaml"); },
              {"/nowhere/m.yaml", "cannot be read"});
}

}  // namespace
}  // namespace sslcd
