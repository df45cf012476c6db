// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/cue.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// What the table of cues says.
PerCue<CosineStatistics> CosinesOfTable();

/// How alike sightings of one object are, and of two.
struct AppearanceOptions {
  PerCue<CosineStatistics> cosine = CosinesOfTable();  ///< no keys but those of the embedding
  /// most evidence of one object's appearance, for or against [nats]; see CueRow::limit_share, too
  double limit = 3.;
};
void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options);

/// Log likelihood ratio of "one object" to "two objects" by all cues, paper IV-C's properties as
/// evidence and never as a gate. Zero where nothing can be compared. Bearings of
/// views are compared as far as the symmetry of the objects allows. O(views of a * views of b *
/// length).
double AppearanceGain(const LayoutObject& a, const LayoutObject& b,
                      const AppearanceOptions& options);

}  // namespace sslcd
