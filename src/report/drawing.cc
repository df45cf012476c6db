// SPDX-License-Identifier: BSD-3-Clause
#include "report/drawing.h"

#include "formats/number_text.h"
#include "report/markup.h"

namespace sslcd {
namespace {

std::string Attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string Style(const Pen& pen) {
  std::string style = Attribute("fill", pen.fill ? Hex(*pen.fill) : "none");
  if (pen.fill && pen.opacity < 1) style += Attribute("fill-opacity", FixedNumber(pen.opacity, 2));
  if (pen.stroke)
    style += Attribute("stroke", Hex(*pen.stroke)) +
             Attribute("stroke-width", RoundedNumber(pen.width, 3));
  if (pen.dashed) style += Attribute("stroke-dasharray", "6 4");
  return style;
}

std::string Points(const std::vector<Vec2>& points) {
  std::string text;
  for (const Vec2& p : points)
    text += (text.empty() ? "" : " ") + FixedNumber(p.x(), 1) + "," + FixedNumber(p.y(), 1);
  return Attribute("points", text);
}

std::string Element(const Shape& shape) {
  const auto at = [&shape](const char* x, const char* y) {
    return Attribute(x, FixedNumber(shape.points[0].x(), 1)) +
           Attribute(y, FixedNumber(shape.points[0].y(), 1));
  };
  switch (shape.kind) {
    case Shape::Kind::kLine: return "<polyline" + Points(shape.points) + Style(shape.pen) + "/>\n";
    case Shape::Kind::kPolygon:
      return "<polygon" + Points(shape.points) + Style(shape.pen) + "/>\n";
    case Shape::Kind::kCircle:
      return "<circle" + at("cx", "cy") + Attribute("r", RoundedNumber(shape.radius, 4)) +
             Style(shape.pen) + "/>\n";
    case Shape::Kind::kText:
      return "<text" + at("x", "y") + Style(shape.pen) + ">" + MarkupText(shape.text) + "</text>\n";
  }
  return "";
}

}  // namespace

void Drawing::Line(std::vector<Vec2> points, const Pen& pen) {
  shapes.push_back({Shape::Kind::kLine, std::move(points), 0, "", pen});
}

void Drawing::Polygon(std::vector<Vec2> points, const Pen& pen) {
  shapes.push_back({Shape::Kind::kPolygon, std::move(points), 0, "", pen});
}

void Drawing::Circle(const Vec2& centre, double radius, const Pen& pen) {
  shapes.push_back({Shape::Kind::kCircle, {centre}, radius, "", pen});
}

void Drawing::Text(const Vec2& at, const std::string& text, Colour colour) {
  Pen pen;
  pen.fill = colour;
  shapes.push_back({Shape::Kind::kText, {at}, 0, text, pen});
}

double TextWidth(const std::string& text) {
  return 0.56 * kTextSize * static_cast<double>(text.size());
}

std::string SvgText(const Drawing& drawing) {
  const std::string width = std::to_string(drawing.width), height = std::to_string(drawing.height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " +
                    height + "\" font-family=\"sans-serif\" font-size=\"" +
                    std::to_string(kTextSize) + "\">\n<rect width=\"" + width + "\" height=\"" +
                    height + "\" fill=\"white\"/>\n";
  for (const Shape& shape : drawing.shapes) svg += Element(shape);
  return svg + "</svg>\n";
}

}  // namespace sslcd
