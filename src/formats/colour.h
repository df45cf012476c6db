// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sslcd {

/// A colour in sRGB.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

}  // namespace sslcd
