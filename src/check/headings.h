// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// rotation_y in radians, from the camera's x axis about its y axis (down). What tells:
/// - |rotation_y| beyond a turn: degrees;
/// - one value in nearly all rows, though alpha varies or the camera turns: no headings;
/// - alpha, which is rotation_y less the bearing of the object (docs/conventions.md);
/// - the 2D boxes, which the cuboids have to fill;
/// - static objects, whose heading in the world does not change while the camera turns.
/// Needs 30 rows whose label has a heading.
Outcome CheckHeadings(const Sequence& sequence);

}  // namespace sslcd::check
