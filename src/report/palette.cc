// SPDX-License-Identifier: BSD-3-Clause
#include "report/palette.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sslcd {
namespace {

// cividis at equal steps
constexpr Colour kCividis[] = {{0, 34, 78},     {18, 53, 112},   {59, 73, 108},   {87, 93, 109},
                               {112, 113, 115}, {138, 134, 120}, {165, 156, 116}, {195, 179, 105},
                               {225, 204, 85},  {254, 232, 56}};

// apart from those of the lines; muted scheme of Paul Tol, Colour Schemes, 2021
constexpr Colour kLabels[] = {{68, 170, 153},  {204, 102, 119}, {221, 204, 119}, {136, 104, 200},
                              {150, 150, 150}, {153, 153, 51},  {170, 110, 60}};

std::uint8_t Between(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
}

}  // namespace

std::string Hex(Colour colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text;
}

Colour ViewpointColour(double change_rad) {
  constexpr std::size_t kSteps = std::size(kCividis) - 1;
  const double at = std::clamp(change_rad / M_PI, 0., 1.) * kSteps;
  const std::size_t low = std::min(static_cast<std::size_t>(at), kSteps - 1);
  const double share = at - static_cast<double>(low);
  const Colour a = kCividis[low], b = kCividis[low + 1];
  return {Between(a.red, b.red, share), Between(a.green, b.green, share),
          Between(a.blue, b.blue, share)};
}

Colour LabelColour(std::size_t i) { return kLabels[i % std::size(kLabels)]; }

}  // namespace sslcd
