// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// How alike sightings of one object are, and of two: cosines of embeddings and of colour
/// signatures. One object seen from opposite sides looks less like itself; the cosine expected
/// falls with the angle between the two views.
struct AppearanceOptions {
  double same_side = 0.75;      ///< mean cosine of one object's embeddings, seen from one side
  double opposite_side = 0.45;  ///< mean cosine of one object's embeddings from opposite sides
  double other_object = 0.3;    ///< mean cosine of different objects' embeddings
  /// most evidence of one object's appearance, for or against; of its colour a third [nats]
  double limit = 3.;
};
void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options);

/// Log likelihood ratio of "one object" to "two objects" by embedding and colour, paper IV-C's
/// properties as evidence and never as a gate. Zero where nothing can be compared. Bearings of
/// views are compared as far as the symmetry of the objects allows. O(views of a * views of b *
/// length).
double AppearanceGain(const LayoutObject& a, const LayoutObject& b,
                      const AppearanceOptions& options);

}  // namespace sslcd
