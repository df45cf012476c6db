// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "formats/colour.h"

namespace sslcd {

/// "#rrggbb".
std::string Hex(Colour colour);

// Colours that colour-blind people tell apart (Okabe and Ito, Color Universal Design, 2008).
inline constexpr Colour kOdometryColour{213, 94, 0}, kTrajectoryColour{0, 114, 178},
    kTruthColour{20, 20, 20}, kMatchedColour{230, 159, 0};

/// The colour of a change of viewpoint in [0, pi]: cividis (Nunez et al., PLoS ONE 2018), dark blue
/// for the same direction, yellow for the opposite one.
Colour ViewpointColour(double change_rad);

/// The colour of the i-th label.
Colour LabelColour(std::size_t i);

}  // namespace sslcd
