// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "detectors/offer_rules.h"

namespace sslcd {
namespace {

const std::vector<double> kImageNetMean = {0.485, 0.456, 0.406};  // R G B
const std::vector<double> kImageNetStd = {0.229, 0.224, 0.225};

/// Boxes with anchors need the statistics of the anchors beside the description.
Offer OfferAnchors(const ModelFacts& facts, ModelLayout layout, std::size_t images) {
  if (facts.answers.size() != 2 || facts.images.size() != images) return std::nullopt;
  const TensorShape scores = ShapeOf(facts, 0), boxes = ShapeOf(facts, 1);
  if (scores.size() != 2 || boxes.size() != 2 || boxes[1] != 12 || boxes[0] != scores[0] ||
      scores[1] < 2)
    return std::nullopt;
  LayoutOffer offer = StartOffer(facts, layout, scores[1] - 1);
  offer.exact = true;
  for (const auto& [number, label] : offer.description.output.labels) {
    offer.description.output.anchors.mean_files[number] = "anchor_mean_" + label + ".npy";
    offer.description.output.anchors.std_files[number] = "anchor_std_" + label + ".npy";
  }
  offer.description.input.resize = ModelInput::Resize::kFitHeight;
  offer.description.input.mean = kImageNetMean;
  offer.description.input.std = kImageNetStd;
  offer.assumptions.push_back(
      "input: as VisualDet3D: fit_height, R G B as for ImageNet; set crop_top_px");
  offer.assumptions.push_back(
      "anchors: 16 scales and 3 ratios; their statistics (anchor_*.npy) have to be added");
  return offer;
}

}  // namespace

Offer OfferStereo3d(const ModelFacts& facts) {
  return OfferAnchors(facts, ModelLayout::kStereo3d, 2);
}
Offer OfferMono3d(const ModelFacts& facts) { return OfferAnchors(facts, ModelLayout::kMono3d, 1); }

Offer OfferMonoFlex(const ModelFacts& facts) {
  if (facts.answers.size() != 5 || facts.images.size() != 1) return std::nullopt;
  const TensorShape heat = ShapeOf(facts, 0), turn = ShapeOf(facts, 4);
  if (heat.size() != 3 || turn.size() != 3) return std::nullopt;
  const std::int64_t channels[] = {heat[0], 2, 1, 3, turn[0]};
  for (std::size_t i = 0; i < 5; ++i)
    if (ShapeOf(facts, i) != TensorShape{channels[i], heat[1], heat[2]}) return std::nullopt;
  if (turn[0] != 2 && turn[0] != 8 && turn[0] != 16) return std::nullopt;
  LayoutOffer offer = StartOffer(facts, ModelLayout::kMonoFlex, heat[0]);
  offer.exact = true;
  offer.description.input.resize = ModelInput::Resize::kFitHeight;
  offer.assumptions.push_back("input: fit_height, R G B, 0..1 (mean and std)");
  return offer;
}

Offer OfferEmbedding(const ModelFacts& facts) {
  const TensorShape& shape = facts.answers[0].shape;
  if (facts.answers.size() != 1 || facts.images.size() != 1 || shape.size() != 2 || shape[1] < 2)
    return std::nullopt;
  const std::int64_t batch = facts.inputs[0].shape[0];
  if (shape[0] != std::max<std::int64_t>(batch, 1)) return std::nullopt;
  LayoutOffer offer = StartOffer(facts, ModelLayout::kEmbedding, 1);
  offer.exact = true;
  offer.description.input.mean = kImageNetMean;
  offer.description.input.std = kImageNetStd;
  offer.assumptions.push_back("input: stretched, R G B as for ImageNet");
  return offer;
}

}  // namespace sslcd
