// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// Scores: one above 30 while none is negative or above 100 says that they are per cent, which
/// would be read as logits. Needs 20 rows.
Outcome CheckScores(const Sequence& sequence);

/// Labels as sequence.yaml spells them; compares without case, plural and signs. Needs 10 rows of
/// a label.
Outcome CheckLabels(const Sequence& sequence);

/// Round objects have no heading and are of symmetry `full`: as long as wide in 95 % of the rows,
/// and of one rotation_y in as many; or the heading of static ones changes by 1.2 rad or more from
/// frame to frame. Needs 30 rows of a label, and for headings 20 that are seen again.
Outcome CheckSymmetry(const Sequence& sequence);

}  // namespace sslcd::check
