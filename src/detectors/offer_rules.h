// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "detectors/layout_offers.h"

namespace sslcd {

using Offer = std::optional<LayoutOffer>;

/// One rule a layout: its description, if the answers of the model have its shapes.
Offer OfferYolox(const ModelFacts& facts);
Offer OfferYoloV5(const ModelFacts& facts);
Offer OfferYoloV8(const ModelFacts& facts);
Offer OfferYoloV10(const ModelFacts& facts);
Offer OfferBoxesScoresLabels(const ModelFacts& facts);
Offer OfferFastestDet(const ModelFacts& facts);
Offer OfferStereo3d(const ModelFacts& facts);
Offer OfferMono3d(const ModelFacts& facts);
Offer OfferMonoFlex(const ModelFacts& facts);
Offer OfferEmbedding(const ModelFacts& facts);

/// The shape of an answer without a batch of one.
TensorShape ShapeOf(const ModelFacts& facts, std::size_t output);

/// A description of the file with this layout, and with labels where it is of a detector.
LayoutOffer StartOffer(const ModelFacts& facts, ModelLayout layout, std::int64_t classes);

}  // namespace sslcd
