// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/layout_offers.h"

#include <algorithm>
#include <functional>
#include <sstream>

#include "detectors/class_names.h"
#include "detectors/offer_rules.h"
#include "sslcd/config/config.h"

namespace sslcd {
namespace {

struct LayoutRow {
  ModelLayout layout;
  const char *name, *needs;
  Offer (*offer)(const ModelFacts& facts);
};
const LayoutRow kLayoutRows[] = {
    {ModelLayout::kYolox, "yolox", "1 x (cells of strides 8, 16, 32) x (5 + classes), not decoded",
     OfferYolox},
    {ModelLayout::kYoloV5, "yolo_v5", "1 x rows x (5 + classes)", OfferYoloV5},
    {ModelLayout::kYoloV8, "yolo_v8", "1 x (4 + classes) x rows", OfferYoloV8},
    {ModelLayout::kYoloV10, "yolo_v10", "1 x rows x 6", OfferYoloV10},
    {ModelLayout::kBoxesScoresLabels, "boxes_scores_labels",
     "three outputs: 1 x rows x 4, 1 x rows, 1 x rows", OfferBoxesScoresLabels},
    {ModelLayout::kFastestDet, "fastestdet", "1 x (5 + classes) x rows of cells x columns of cells",
     OfferFastestDet},
    {ModelLayout::kStereo3d, "stereo3d",
     "two images; 1 x anchors x (classes + 1), 1 x anchors x 12", OfferStereo3d},
    {ModelLayout::kMono3d, "mono3d", "1 x anchors x (classes + 1), 1 x anchors x 12", OfferMono3d},
    {ModelLayout::kMonoFlex, "monoflex",
     "five maps of one size: classes, 2, 1, 3, and 2, 8 or 16 channels", OfferMonoFlex},
    {ModelLayout::kEmbedding, "embedding", "batch x length", OfferEmbedding}};

/// Leaves out the keys without a value, and the anchors of a layout that has none.
std::string WithoutEmptyKeys(const std::string& yaml, ModelLayout layout) {
  std::istringstream lines(HasAnchors(layout) ? yaml : yaml.substr(0, yaml.find("  anchors:")));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const std::string value = line.substr(line.find(':') + 1);
    if (value != " ''" && value != " {}" && value != " []") text += line + "\n";
  }
  return text;
}

}  // namespace

TensorShape ShapeOf(const ModelFacts& facts, std::size_t output) {
  const TensorShape& shape = facts.answers[output].shape;
  return shape.size() > 1 && shape[0] == 1 ? TensorShape(shape.begin() + 1, shape.end()) : shape;
}

LayoutOffer StartOffer(const ModelFacts& facts, ModelLayout layout, std::int64_t classes) {
  LayoutOffer offer;
  ModelDescription& model = offer.description;
  model.file = facts.file;
  model.input.width_px = facts.width_px;
  model.input.height_px = facts.height_px;
  model.input.size = facts.size;
  if (!facts.size.empty()) model.input.left = facts.images[0];
  model.output.layout = layout;
  model.output.class_count = static_cast<int>(std::min<std::int64_t>(classes, 100000));
  if (TaskOf(layout) != ModelTask::kEmbed) {
    const ClassLabels labels = ChooseLabels(facts.class_names, model.output.class_count);
    model.output.labels = labels.labels;
    offer.assumptions.push_back(labels.assumption);
  }
  return offer;
}

std::vector<LayoutOffer> OfferLayouts(const ModelFacts& facts) {
  std::vector<LayoutOffer> offers;
  if (facts.answers.empty()) return offers;
  for (const LayoutRow& row : kLayoutRows)
    if (Offer offer = row.offer(facts)) offers.push_back(std::move(*offer));
  const auto exact = [](const LayoutOffer& offer) { return offer.exact; };
  if (std::any_of(offers.begin(), offers.end(), exact))
    offers.erase(std::remove_if(offers.begin(), offers.end(), std::not_fn(exact)), offers.end());
  return offers;
}

std::string LayoutsAndShapes() {
  std::string text;
  for (const LayoutRow& row : kLayoutRows)
    text += std::string("\n  ") + row.name + ": " + row.needs;
  return text;
}

std::string NameOf(ModelLayout layout) {
  for (const LayoutRow& row : kLayoutRows)
    if (row.layout == layout) return row.name;
  return "";
}

std::string DescriptionText(const LayoutOffer& offer) {
  std::string text =
      "# Written by 'sslcd_run model inspect'; docs/models.md explains the keys. What the model "
      "does\n"
      "# not tell was assumed. Look at its boxes (sslcd_run detect --overlays) before you rely on "
      "it.\n";
  for (const std::string& assumption : offer.assumptions) text += "# - " + assumption + "\n";
  ModelDescription model = offer.description;
  const auto fields = [&](FieldVisitor& visitor) { DescribeFields(visitor, model); };
  return text + WithoutEmptyKeys(DumpConfig(fields, false), model.output.layout);
}

}  // namespace sslcd
