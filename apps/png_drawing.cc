// SPDX-License-Identifier: BSD-3-Clause
#include "png_drawing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sslcd/core/error.h"

namespace sslcd::apps {
namespace {

constexpr double kScale = 2;
constexpr int kBits = 4;  // of a coordinate's fraction
constexpr double kDash = 6, kDashGap = 4;

cv::Scalar Bgr(Colour colour) {
  return {double(colour.blue), double(colour.green), double(colour.red)};
}

cv::Point Fixed(const Vec2& p) {
  const double unit = kScale * (1 << kBits);
  return {static_cast<int>(std::lround(p.x() * unit)), static_cast<int>(std::lround(p.y() * unit))};
}

std::vector<cv::Point> Fixed(const std::vector<Vec2>& points) {
  std::vector<cv::Point> fixed;
  for (const Vec2& p : points) fixed.push_back(Fixed(p));
  return fixed;
}

// The parts of a line that its dashes show.
std::vector<std::vector<Vec2>> Dashes(const std::vector<Vec2>& points) {
  std::vector<std::vector<Vec2>> dashes;
  double left = kDash;
  bool on = true;
  for (std::size_t i = 1; i < points.size(); ++i) {
    Vec2 from = points[i - 1];
    const Vec2 to = points[i];
    double length = (to - from).norm();
    while (length > 0) {
      const double step = std::min(left, length);
      const Vec2 next = from + (to - from) * (step / length);
      if (on) dashes.push_back({from, next});
      from = next;
      length -= step;
      left -= step;
      if (left > 0) continue;
      on = !on;
      left = on ? kDash : kDashGap;
    }
  }
  return dashes;
}

class Canvas {
 public:
  explicit Canvas(const Drawing& drawing)
      : image_(static_cast<int>(drawing.height * kScale), static_cast<int>(drawing.width * kScale),
               CV_8UC3, cv::Scalar::all(255)) {}

  void Draw(const Shape& shape) {
    switch (shape.kind) {
      case Shape::Kind::kLine: Stroke(shape.points, shape.pen, false); return;
      case Shape::Kind::kPolygon:
        Fill(Fixed(shape.points), shape.pen);
        Stroke(shape.points, shape.pen, true);
        return;
      case Shape::Kind::kCircle: Circle(shape); return;
      case Shape::Kind::kText: Text(shape); return;
    }
  }

  std::string Png() const {
    std::vector<unsigned char> bytes;
    if (!cv::imencode(".png", image_, bytes))
      throw Error(ErrorKind::kOutput, "OpenCV cannot write PNG files: write an SVG instead");
    return {bytes.begin(), bytes.end()};
  }

 private:
  static int Width(const Pen& pen) {
    return std::max(1, static_cast<int>(std::lround(pen.width * kScale)));
  }

  void Stroke(const std::vector<Vec2>& points, const Pen& pen, bool closed) {
    if (!pen.stroke) return;
    const auto lines = pen.dashed ? Dashes(points) : std::vector<std::vector<Vec2>>{points};
    for (const auto& line : lines)
      cv::polylines(image_, std::vector<std::vector<cv::Point>>{Fixed(line)}, closed,
                    Bgr(*pen.stroke), Width(pen), cv::LINE_AA, kBits);
  }

  void Fill(const std::vector<cv::Point>& polygon, const Pen& pen) {
    if (!pen.fill) return;
    cv::Mat over = pen.opacity < 1 ? image_.clone() : image_;
    cv::fillPoly(over, std::vector<std::vector<cv::Point>>{polygon}, Bgr(*pen.fill), cv::LINE_AA,
                 kBits);
    if (pen.opacity < 1) cv::addWeighted(over, pen.opacity, image_, 1 - pen.opacity, 0, image_);
  }

  void Circle(const Shape& shape) {
    std::vector<Vec2> points;
    constexpr int kCorners = 24;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2 * M_PI * i / kCorners;
      points.push_back(shape.points[0] + shape.radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    Fill(Fixed(points), shape.pen);
    Stroke(points, shape.pen, true);
  }

  void Text(const Shape& shape) {
    constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
    const double size = kTextSize * kScale;
    const double widest = TextWidth(shape.text) * kScale;
    const int drawn = cv::getTextSize(shape.text, kFont, 1, 1, nullptr).width;
    const double scale = std::min(.031 * size, widest / std::max(1, drawn));
    const cv::Point at(static_cast<int>(shape.points[0].x() * kScale),
                       static_cast<int>(shape.points[0].y() * kScale));
    cv::putText(image_, shape.text, at, kFont, scale, Bgr(shape.pen.fill.value_or(Colour())), 2,
                cv::LINE_AA);
  }

  cv::Mat image_;
};

}  // namespace

std::string PngBytes(const Drawing& drawing) {
  Canvas canvas(drawing);
  for (const Shape& shape : drawing.shapes) canvas.Draw(shape);
  return canvas.Png();
}

}  // namespace sslcd::apps
