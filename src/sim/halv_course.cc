// SPDX-License-Identifier: BSD-3-Clause
#include "sim/halv_course.h"

#include <array>
#include <cmath>
#include <string>

#include "sim/dubins.h"
#include "sim/random.h"
#include "sim/streams.h"
#include "sslcd/core/error.h"

namespace sslcd::sim {
namespace {

// Set by hand.
constexpr double kRadius = 6;    // of a quarter turn [m]
constexpr double kTightest = 4;  // smallest radius of the way to the second pass [m]
constexpr double kStep = 0.5;    // from one point of the course to the next [m]

std::vector<PathPiece> Corners(const std::vector<double>& straights, int corners) {
  std::vector<PathPiece> pieces;
  for (std::size_t i = 0; i < straights.size(); ++i) {
    pieces.push_back({straights[i], 0});
    if (static_cast<int>(i) < corners) pieces.push_back({0.5 * M_PI * kRadius, 1 / kRadius});
  }
  return pieces;
}

}  // namespace

const HalvCase& HalvCaseOf(int number) {
  static const std::array<HalvCase, 4> kCases = {{
      {"rectangle", Corners({76, 37.8, 76}, 3), 54, 30, -5, 40, 60, 120, 1.670},
      {"straight out and back", {{105, 0}}, 58, 44, 52, 0, 170, 180, 1.336},
      {"curve", {{20, 0}, {60, 1 / 40.}, {36, -1 / 26.}}, 32, 28, 34, 0, 120, 170, 0.814},
      {"small loop", Corners({26, 4.6, 26, 12}, 3), 16, 10, 26, 0, 0, 45, 0.720},
  }};
  if (number < 1 || number > static_cast<int>(kCases.size()))
    throw Error(ErrorKind::kUsage, "case is " + std::to_string(number) + ", must be 1 to 4");
  return kCases[number - 1];
}

HalvCourse MakeHalvCourse(const HalvCase& shape, double low_deg, double high_deg, double size,
                          std::uint64_t seed) {
  Random random(seed, kPathStream);
  std::vector<PathPiece> pieces = shape.out;
  for (PathPiece& piece : pieces) piece.length_m *= piece.curvature_per_m == 0 ? size : 1;
  const Path out(pieces);
  const Path::Point meet = out.At(shape.meet_m * size);
  const double angle = random.Uniform(low_deg, high_deg) * M_PI / 180;
  constexpr double kAsideSigma = 0.4;  // lateral offset of real passes [m]; set by hand
  const double aside = random.Normal(0, kAsideSigma);

  std::vector<PathPiece> shortest;
  for (double turn : {angle, -angle}) {
    Path::Point start{meet.x, meet.z, meet.heading + turn};
    start.x += aside * std::cos(start.heading) - shape.before_m * size * std::sin(start.heading);
    start.z += -aside * std::sin(start.heading) - shape.before_m * size * std::cos(start.heading);
    std::vector<PathPiece> way = ArcLineArc(out.At(out.length()), start, kTightest);
    if (shortest.empty() || LengthOf(way) < LengthOf(shortest)) shortest = std::move(way);
  }
  pieces.insert(pieces.end(), shortest.begin(), shortest.end());
  const double last_leg = LengthOf(pieces);
  pieces.push_back({(shape.before_m + shape.after_m) * size, 0});
  if (shape.along_m > 0) {
    constexpr double kMerge = 10;  // [m] before the crossing; set by hand
    const Path crossed(pieces);
    Path::Point merge = out.At(shape.meet_m * size - kMerge);
    merge.heading += M_PI;
    for (const PathPiece& piece : ArcLineArc(crossed.At(crossed.length()), merge, kTightest))
      pieces.push_back(piece);
    pieces.push_back({shape.along_m * size, 0});
  }

  HalvCourse course{Path(pieces), out.length(), last_leg, angle, {}};
  for (double s = 0; s <= course.path.length(); s += kStep)
    course.points.push_back(course.path.At(s));
  return course;
}

}  // namespace sslcd::sim
