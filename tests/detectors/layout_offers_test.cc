// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/layout_offers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "../inference/test_models.h"
#include "../support/temp_folder.h"
#include "sslcd/detectors/detector_2d.h"

namespace sslcd {
namespace {

using testing::ElementsAre;

/// A model of one image of 1248 x 384 that answers with zeros of these shapes.
ModelFacts Facts(const std::vector<TensorShape>& answers) {
  ModelFacts facts;
  facts.file = "m.onnx";
  facts.inputs = {{"images", {1, 3, 384, 1248}, "float32"}};
  facts.images = {"images"};
  facts.width_px = 1248;
  facts.height_px = 384;
  for (const TensorShape& shape : answers) {
    facts.outputs.push_back({"out" + std::to_string(facts.outputs.size()), shape, "float32"});
    facts.answers.push_back({shape, std::vector<float>(ElementCount(shape))});
  }
  return facts;
}

std::vector<std::string> Names(const ModelFacts& facts) {
  std::vector<std::string> names;
  for (const LayoutOffer& offer : OfferLayouts(facts))
    names.push_back(NameOf(offer.description.output.layout));
  return names;
}

TEST(OfferLayouts, TellsTheYolosByTheirRows) {  // 48 * 156 + 24 * 78 + 12 * 39 = 9828 cells
  EXPECT_THAT(Names(Facts({{1, 9828, 85}})), ElementsAre("yolox"));
  EXPECT_THAT(Names(Facts({{9828, 85}})), ElementsAre("yolox")) << "without a batch";
  EXPECT_THAT(Names(Facts({{1, 3 * 9828, 85}})), ElementsAre("yolo_v5"));
  EXPECT_THAT(Names(Facts({{1, 84, 9828}})), ElementsAre("yolo_v8"));
  EXPECT_THAT(Names(Facts({{1, 5, 9828}})), ElementsAre("yolo_v8")) << "of one class";
  EXPECT_THAT(Names(Facts({{1, 9828, 6}})), ElementsAre("yolox")) << "of one class";
  EXPECT_THAT(Names(Facts({{1, 300, 6}})), ElementsAre("yolo_v10"));
  EXPECT_THAT(Names(Facts({{1, 300, 84}})), ElementsAre("yolo_v5", "yolo_v8")) << "either, loosely";
  EXPECT_FALSE(OfferLayouts(Facts({{1, 300, 84}}))[0].exact);
}

TEST(OfferLayouts, DecodedYoloxIsYoloV5) {
  ModelFacts facts = Facts({{1, 9828, 7}});
  for (int i = 0; i < 9828; ++i) facts.answers[0].values[7 * i] = 8.f * (i % 156) + 4;  // [px]
  const LayoutOffer offer = OfferLayouts(facts).at(0);
  EXPECT_EQ(offer.description.output.layout, ModelLayout::kYoloV5);
  EXPECT_EQ(offer.description.output.class_count, 2);
  EXPECT_EQ(offer.description.input.resize, ModelInput::Resize::kLetterboxCorner);
  EXPECT_EQ(offer.description.input.scale, 1);
}

TEST(OfferLayouts, TheOthers) {
  EXPECT_THAT(Names(Facts({{1, 85, 24, 78}})), ElementsAre("fastestdet"));
  EXPECT_THAT(Names(Facts({{1, 85, 24, 77}})), ElementsAre()) << "cells of two sizes";
  EXPECT_THAT(Names(Facts({{1, 512}})), ElementsAre("embedding"));
  EXPECT_THAT(Names(Facts({{1, 40, 3}, {1, 40, 12}})), ElementsAre("mono3d"));
  EXPECT_THAT(Names(Facts({{1, 40, 3}, {1, 41, 12}})), ElementsAre());
  EXPECT_THAT(Names(Facts({{1, 3, 9, 9}, {1, 2, 9, 9}, {1, 1, 9, 9}, {1, 3, 9, 9}, {1, 8, 9, 9}})),
              ElementsAre("monoflex"));
  EXPECT_THAT(Names(Facts({{1, 3, 9, 9}, {1, 2, 9, 9}, {1, 1, 9, 9}, {1, 3, 9, 9}, {1, 9, 9, 9}})),
              ElementsAre());
  EXPECT_THAT(Names(Facts({})), ElementsAre());
  EXPECT_THAT(Names(Facts({{1, 512, 1, 1}})), ElementsAre());
}

TEST(OfferLayouts, OutputsInAnyOrder) {
  ModelFacts facts = Facts({{1, 9}, {1, 9}, {1, 9, 4}});
  facts.outputs[0].name = "labels";
  const LayoutOffer offer = OfferLayouts(facts).at(0);
  EXPECT_EQ(offer.description.output.layout, ModelLayout::kBoxesScoresLabels);
  EXPECT_EQ(offer.description.output.names,
            (std::map<int, std::string>{{0, "out2"}, {1, "out1"}, {2, "labels"}}));
}

TEST(InspectModel, OffersTheLayoutOfEachTestModelInADescriptionThatLoads) {
  SSLCD_RUNTIME();
  const TempFolder folder;
  for (const char* name : {"yolo_v5", "yolox", "yolo_v8", "boxes_scores_labels", "fastestdet"}) {
    SCOPED_TRACE(name);
    const std::vector<LayoutOffer> offers =
        OfferLayouts(InspectModel(TestModel(std::string(name) + ".onnx"), 0, 0, {}));
    const auto offer = std::find_if(offers.begin(), offers.end(), [&](const LayoutOffer& o) {
      return NameOf(o.description.output.layout) == name;
    });
    ASSERT_NE(offer, offers.end());
    EXPECT_NO_THROW(Detector2d::Load(folder.Write("m.yaml", DescriptionText(*offer))));
  }
  const LayoutOffer yolox = OfferLayouts(InspectModel(TestModel("yolox.onnx"), 0, 0, {})).at(0);
  EXPECT_EQ(yolox.description.output.labels,
            (std::map<int, std::string>{{0, "Car"}, {2, "Truck"}}));
  for (const char* name : {"stereo3d", "mono3d", "monoflex", "monoflex_4", "embedding"})
    EXPECT_EQ(Names(InspectModel(TestModel(std::string(name) + ".onnx"), 0, 0, {})).size(), 1u)
        << name;
}

TEST(InspectModel, RefusesWhatTakesNoImage) {
  SSLCD_RUNTIME();
  ExpectError([] { InspectModel(TestModel("bad_values.onnx"), 0, 0, {}); },
              {"bad_values.onnx", "no input takes an image", "'x' float32 1x2"});
  ExpectError([] { InspectModel(TestModel("any_size.onnx"), 0, 0, {}); },
              {"any_size.onnx", "any size (1x3x?x?)", "--width and --height"});
  EXPECT_EQ(OfferLayouts(InspectModel(TestModel("any_size.onnx"), 64, 32, {})).size(), 0u);
  ExpectError([] { InspectModel(TestModel("yolo_v5.onnx"), 32, 32, {}); },
              {"1x3x48x64", "another size", "leave --width"});
}

// The file says how many images there are at once; memory is asked for only after a look at it.
TEST(InspectModel, RefusesTooManyImagesAtOnce) {
  SSLCD_RUNTIME();
  std::ifstream model(TestModel("any_size.onnx"), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(model), {}};
  const std::string one_of_three("\x0a\x02\x08\x01\x0a\x02\x08\x03", 8);  // dimensions 1, 3
  for (std::size_t at = 0; (at = bytes.find(one_of_three, at)) != std::string::npos; ++at)
    bytes[at + 3] = 127;
  const TempFolder folder;
  const std::string path = folder.Write("many.onnx", bytes);
  ExpectError([&] { InspectModel(path, kLargestInput, kLargestInput, {}); },
              {"many.onnx", "127x3x?x?", "too many values", "for one image"});
}

}  // namespace
}  // namespace sslcd
