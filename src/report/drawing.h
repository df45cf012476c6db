// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/palette.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// How a shape is drawn. Lengths are pixels.
struct Pen {
  std::optional<Colour> stroke, fill;
  double width = 1;
  double opacity = 1;  ///< of the filling
  bool dashed = false;
};

/// One element of a drawing, in pixels, x to the right, y down.
struct Shape {
  enum class Kind { kLine, kPolygon, kCircle, kText };
  Kind kind = Kind::kLine;
  std::vector<Vec2> points;  ///< of a circle its centre, of a text the left end of its base line
  double radius = 0;
  std::string text;
  Pen pen;
};

/// A picture as a list of shapes, on white.
struct Drawing {
  int width = 0, height = 0;
  std::vector<Shape> shapes;

  void Line(std::vector<Vec2> points, const Pen& pen);
  void Polygon(std::vector<Vec2> points, const Pen& pen);
  void Circle(const Vec2& centre, double radius, const Pen& pen);
  void Text(const Vec2& at, const std::string& text, Colour colour);
};

inline constexpr int kTextSize = 15;  ///< height of the letters' line [px]

/// Width of a text in that size, roughly. [px]
double TextWidth(const std::string& text);

/// Returns an SVG file.
std::string SvgText(const Drawing& drawing);

}  // namespace sslcd
