// SPDX-License-Identifier: BSD-3-Clause
#include "report/legend.h"

#include <algorithm>
#include <cmath>

#include "formats/number_text.h"

namespace sslcd {
namespace {

constexpr double kRow = 24, kMargin = 12, kSwatch = 24;  // [px]
constexpr Colour kInk{40, 40, 40};

// Places items from left to right, and in the next row where one does not fit.
class Rows {
 public:
  Rows(double top, Drawing& page) : y_(top + kRow), page_(page) {}

  // Room for a swatch and a text; returns the left end of the swatch's middle line.
  Vec2 Item(double swatch, const std::string& text) {
    const double width = swatch + 6 + TextWidth(text) + 18;
    if (x_ > kMargin && x_ + width > page_.width - kMargin) {
      x_ = kMargin;
      y_ += kRow;
    }
    const Vec2 at(x_, y_);
    page_.Text(Vec2(x_ + swatch + 6, y_), text, kInk);
    x_ += width;
    return at - Vec2(0, 5);
  }

  double bottom() const { return y_ + kMargin; }

 private:
  double x_ = kMargin, y_;
  Drawing& page_;
};

void LineItem(Rows& rows, const std::string& text, Colour colour, bool dashed, Drawing& page) {
  const Vec2 at = rows.Item(kSwatch, text);
  Pen pen;
  pen.stroke = colour;
  pen.width = 2.5;
  pen.dashed = dashed;
  page.Line({at, at + Vec2(kSwatch, 0)}, pen);
}

void BoxItem(Rows& rows, const std::string& text, Colour colour, Drawing& page) {
  const Vec2 at = rows.Item(12, text);
  Pen pen;
  pen.fill = colour;
  pen.stroke = Colour{90, 90, 90};
  pen.width = .5;
  page.Polygon({at + Vec2(0, -6), at + Vec2(12, -6), at + Vec2(12, 6), at + Vec2(0, 6)}, pen);
}

void ViewpointItem(Rows& rows, const std::string& text, Drawing& page) {
  constexpr int kSteps = 15;
  constexpr double kStep = 6;
  const Vec2 at = rows.Item(kSteps * kStep, text);
  for (int i = 0; i < kSteps; ++i) {
    Pen pen;
    pen.fill = ViewpointColour(M_PI * i / (kSteps - 1));
    const double left = i * kStep, right = left + kStep;
    page.Polygon(
        {at + Vec2(left, -6), at + Vec2(right, -6), at + Vec2(right, 6), at + Vec2(left, 6)}, pen);
  }
}

void ScaleBar(Rows& rows, double scale, double page_width, Drawing& page) {
  double metres = std::pow(10, std::floor(std::log10(page_width / scale / 5)));
  for (const double times : {5., 2.}) {
    if (metres * times * scale > page_width / 5) continue;
    metres *= times;
    break;
  }
  const double length = metres * scale;
  const Vec2 at = rows.Item(length, RoundedNumber(metres, 6) + " m");
  Pen pen;
  pen.stroke = kInk;
  pen.width = 2;
  page.Line({at + Vec2(0, -5), at, at + Vec2(length, 0), at + Vec2(length, -5)}, pen);
}

std::string Count(std::size_t count, const char* one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace

double DrawLegend(const Legend& legend, double top, Drawing& page) {
  Rows rows(top, page);
  LineItem(rows, "odometry", kOdometryColour, false, page);
  LineItem(rows, "corrected", kTrajectoryColour, false, page);
  if (legend.truth) LineItem(rows, "ground truth", kTruthColour, true, page);
  for (const auto& [label, colour] : legend.labels) BoxItem(rows, label, colour, page);
  if (legend.one_loop) {
    const LoopClosure& loop = legend.loops[0];
    BoxItem(rows,
            Count(loop.pairs.size(), "object") + " matched from directions " +
                FixedNumber(loop.viewpoint_change_rad * 180 / M_PI, 0) + " degrees apart",
            kMatchedColour, page);
  } else if (!legend.loops.empty()) {
    std::string text = Count(legend.all_loops, "loop");
    if (legend.loops.size() < legend.all_loops)
      text = std::to_string(legend.loops.size()) + " of " + text;
    ViewpointItem(rows, text + ", viewpoint change 0 to 180 degrees", page);
  }
  ScaleBar(rows, legend.scale, page.width, page);
  return rows.bottom() - top;
}

}  // namespace sslcd
