// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/random.h"
#include "sim/sensor.h"
#include "sim/world.h"
#include "sslcd/core/fields.h"

namespace sslcd::sim {

/// What objects look like: re-identification embeddings and colours.
///
/// An embedding is the sum of what all objects share, of what an object shows from everywhere, of
/// what it shows from one side (turns with the viewing direction), and of noise that grows with
/// range. Means and spread of the cosines follow from the shares and the dimension.
struct AppearanceNoise {
  int dimension = 52;           ///< of the embeddings; fewer: the cosines scatter more
  double same_side = 0.75;      ///< mean cosine of two sightings of an object from the same side
  double opposite_side = 0.45;  ///< ... from opposite sides
  double other_object = 0.3;    ///< ... of different objects
  /// how much more the sides of some objects differ than those of others; 0 to 1
  double side_spread = 0.3;
  /// how much better some images are than others; share of the noise, 0 to 1
  double unevenness = 0.65;
  double light = 0.15;  ///< log brightness of one image of an object
};
void DescribeFields(FieldVisitor& visitor, AppearanceNoise& noise);

/// Fills in `embedding` and `colour` (a vector of perception/colour.h with default options) of
/// every detection. Throws Error(kUsage) where no vectors have such cosines.
void AddAppearance(const World& world, const AppearanceNoise& noise, std::uint64_t seed,
                   SimulatedDetections& detections);

/// A car's colour as on real roads: half are white, grey or black.
Vec3 DrawPaint(Random& random);

}  // namespace sslcd::sim
