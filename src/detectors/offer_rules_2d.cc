// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>

#include "core/median.h"
#include "detectors/cells.h"
#include "detectors/offer_rules.h"

namespace sslcd {
namespace {

/// Whether there is one answer, and it has so many dimensions without the batch.
bool IsOne(const ModelFacts& facts, std::size_t dimensions) {
  return facts.answers.size() == 1 && ShapeOf(facts, 0).size() == dimensions &&
         facts.images.size() == 1;
}

/// Whether `count` is the number of cells of a YOLO's grids, with `per_cell` boxes each.
bool IsGrid(const ModelFacts& facts, std::int64_t count, int per_cell) {
  const std::initializer_list<int> usual[] = {{8, 16, 32}, {8, 16, 32, 64}, {4, 8, 16, 32}};
  return std::any_of(std::begin(usual), std::end(usual), [&](const auto& strides) {
    return count == per_cell * CellCount(facts.width_px, facts.height_px, strides);
  });
}

/// The number of classes of a model whose outputs do not tell it; COCO's where the file has no
/// names.
int NamedClasses(const ModelFacts& facts) {
  return facts.class_names.empty() ? 80 : facts.class_names.rbegin()->first + 1;
}

/// Ultralytics' preparation of images.
LayoutOffer StartYolo(const ModelFacts& facts, ModelLayout layout, std::int64_t classes) {
  LayoutOffer offer = StartOffer(facts, layout, classes);
  offer.description.input.resize = ModelInput::Resize::kLetterbox;
  offer.assumptions.push_back("input: as ultralytics' models: letterbox, R G B, 0..1");
  return offer;
}

/// Whether the rows of YOLOX's finest grid hold offsets in cells rather than centres in pixels.
bool HoldsOffsets(const ModelFacts& facts) {
  const Tensor& rows = facts.answers[0];
  const std::size_t columns = rows.shape.back();
  const int stride = *kYoloxStrides.begin(), across = Cells(facts.width_px, stride);
  std::vector<double> as_offsets, as_pixels;  // distances from the cell's middle [px]
  for (int i = 0; i < across * Cells(facts.height_px, stride); ++i) {
    const double x = rows.values[i * columns];
    as_offsets.push_back(stride * std::abs(x - 0.5));
    as_pixels.push_back(std::abs(x - stride * (i % across + 0.5)));
  }
  return Median(as_offsets) < Median(as_pixels);
}

}  // namespace

Offer OfferYolox(const ModelFacts& facts) {
  if (!IsOne(facts, 2)) return std::nullopt;
  const TensorShape shape = ShapeOf(facts, 0);
  if (shape[1] < 6 || shape[0] != CellCount(facts.width_px, facts.height_px, kYoloxStrides))
    return std::nullopt;
  const bool raw = HoldsOffsets(facts);
  LayoutOffer offer =
      StartOffer(facts, raw ? ModelLayout::kYolox : ModelLayout::kYoloV5, shape[1] - 5);
  offer.exact = true;
  ModelInput& input = offer.description.input;
  input.resize = ModelInput::Resize::kLetterboxCorner;
  input.channels = ModelInput::Channels::kBgr;
  input.scale = 1;
  offer.assumptions.push_back("input: as YOLOX: letterbox_corner, B G R, 0..255");
  offer.assumptions.push_back(
      std::string("YOLOX: the rows are one a cell, ") +
      (raw ? "and its answer to a grey image is not decoded"
           : "and its answer to a grey image is decoded, so its boxes are those of yolo_v5"));
  return offer;
}

Offer OfferYoloV5(const ModelFacts& facts) {
  if (!IsOne(facts, 2)) return std::nullopt;
  const TensorShape shape = ShapeOf(facts, 0);
  if (shape[1] < 6) return std::nullopt;
  LayoutOffer offer = StartYolo(facts, ModelLayout::kYoloV5, shape[1] - 5);
  offer.exact = IsGrid(facts, shape[0], 3);
  return offer;
}

Offer OfferYoloV8(const ModelFacts& facts) {
  if (!IsOne(facts, 2)) return std::nullopt;
  const TensorShape shape = ShapeOf(facts, 0);
  if (shape[0] < 5) return std::nullopt;
  LayoutOffer offer = StartYolo(facts, ModelLayout::kYoloV8, shape[0] - 4);
  offer.exact = IsGrid(facts, shape[1], 1);
  return offer;
}

Offer OfferYoloV10(const ModelFacts& facts) {
  constexpr int kMostBoxes = 1000;  // without duplicates; ultralytics' files have 300
  if (!IsOne(facts, 2)) return std::nullopt;
  const TensorShape shape = ShapeOf(facts, 0);
  if (shape[1] != 6 || shape[0] > kMostBoxes) return std::nullopt;
  LayoutOffer offer = StartYolo(facts, ModelLayout::kYoloV10, NamedClasses(facts));
  offer.description.output.nms_iou = 1;
  offer.exact = shape[0] >= 100 && !IsGrid(facts, shape[0], 1) && !IsGrid(facts, shape[0], 3);
  return offer;
}

Offer OfferBoxesScoresLabels(const ModelFacts& facts) {
  if (facts.answers.size() < 3 || facts.images.size() != 1) return std::nullopt;
  std::map<int, std::string> names;
  const auto count = [&](std::size_t i) {
    return static_cast<std::int64_t>(facts.answers[i].values.size());
  };
  std::int64_t boxes = -1;
  for (std::size_t i = 0; i < facts.answers.size(); ++i) {
    const TensorShape shape = ShapeOf(facts, i);
    if (boxes < 0 && shape.size() == 2 && shape[1] == 4) {
      boxes = shape[0];
      names[0] = facts.outputs[i].name;
    }
  }
  for (std::size_t i = 0; i < facts.answers.size() && boxes >= 0; ++i) {
    if (ShapeOf(facts, i).size() != 1 || count(i) != boxes) continue;
    const std::string& name = facts.outputs[i].name;
    const bool classes = facts.outputs[i].type != "float32" ||
                         name.find("label") != std::string::npos ||
                         name.find("class") != std::string::npos;
    names.emplace(classes ? 2 : 1, name);
  }
  if (names.size() != 3) return std::nullopt;
  LayoutOffer offer = StartOffer(facts, ModelLayout::kBoxesScoresLabels, NamedClasses(facts));
  offer.exact = true;
  offer.description.output.names = names;
  offer.description.output.nms_iou = 1;
  offer.assumptions.push_back("input: stretched, R G B, 0..1");
  offer.assumptions.push_back(
      "boxes: left top right bottom in pixels of the input (box_format, normalised_boxes)");
  return offer;
}

Offer OfferFastestDet(const ModelFacts& facts) {
  if (!IsOne(facts, 3)) return std::nullopt;
  const TensorShape shape = ShapeOf(facts, 0);
  if (shape[0] < 6 || shape[1] * facts.width_px != shape[2] * facts.height_px) return std::nullopt;
  LayoutOffer offer = StartOffer(facts, ModelLayout::kFastestDet, shape[0] - 5);
  offer.exact = true;
  offer.description.input.channels = ModelInput::Channels::kBgr;
  offer.description.output.box_sigma = 0.12;
  offer.assumptions.push_back("input: as FastestDet: stretched, B G R, 0..1");
  return offer;
}

}  // namespace sslcd
