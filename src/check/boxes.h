// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/outcome.h"

namespace sslcd::check {

/// The 2D box of a detection is the outline of its cuboid in the image: the median IoU of both
/// tells the order of the sizes, centre from bottom, the format of the boxes, focal length and
/// camera. Needs 30 boxes that the image does not cut, and a calibration.
Outcome CheckBoxes(const Sequence& sequence);

}  // namespace sslcd::check
