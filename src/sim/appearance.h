// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/random.h"
#include "sim/sensor.h"
#include "sim/world.h"
#include "sslcd/core/fields.h"

namespace sslcd::sim {

/// The appearance of objects: re-identification embeddings and colours.
/// An embedding is the sum of a part common to all objects, a part of the object, a part of the
/// visible side (it rotates with the viewing direction) and noise that grows with range. The shares
/// and the dimension determine mean and spread of the cosines.
struct AppearanceNoise {
  /// of the embeddings; fewer dimensions: more scatter of the cosines
  int dimension = 52;
  double same_side = 0.75;      ///< mean cosine of two sightings of an object from the same side
  double opposite_side = 0.45;  ///< mean cosine of two sightings from opposite sides
  double other_object = 0.3;    ///< mean cosine of different objects
  /// variation between objects of the difference of their sides; 0 to 1
  double side_spread = 0.3;
  /// variation of the noise between images; share of the noise, 0 to 1
  double unevenness = 0.65;
  double light = 0.15;  ///< log brightness of one image of an object
};
void DescribeFields(FieldVisitor& visitor, AppearanceNoise& noise);

/// Fills in `embedding` and `colour` (a vector of perception/colour.h with default options) of
/// every detection. Throws Error(kUsage) if no vectors have such cosines.
void AddAppearance(const World& world, const AppearanceNoise& noise, std::uint64_t seed,
                   SimulatedDetections& detections);

/// Draws a car's colour with the frequencies of real roads: half are white, grey or black.
Vec3 DrawPaint(Random& random);

}  // namespace sslcd::sim
