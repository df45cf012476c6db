// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "detectors/model_description.h"
#include "detectors/model_facts.h"

namespace sslcd {

/// A description that a model's shapes allow.
struct LayoutOffer {
  ModelDescription description;
  bool exact = false;  ///< the number of rows or cells is the layout's for this size of input, too
  std::vector<std::string> assumptions;  ///< what the file does not tell, for people to check
};

/// The layouts that fit the model's answers: the exact ones, or all others if there are none.
std::vector<LayoutOffer> OfferLayouts(const ModelFacts& facts);

/// All layouts and the outputs that they need, a line each.
std::string LayoutsAndShapes();

/// The name of a layout in a description.
std::string NameOf(ModelLayout layout);

/// The description's YAML, with the assumptions as comments. `description.file` is written as it
/// is.
std::string DescriptionText(const LayoutOffer& offer);

}  // namespace sslcd
