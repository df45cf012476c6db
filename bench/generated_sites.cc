// SPDX-License-Identifier: BSD-3-Clause
#include "generated_sites.h"

#include <algorithm>
#include <cmath>

#include "sim/random.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using sim::Random;

constexpr double kShortestPath = 75, kLongestPath = 100;  // [m]

std::string DrawVehicle(Random& random) {
  const double kind = random.Uniform();
  return kind < 0.8 ? "Car" : kind < 0.92 ? "Van" : "Truck";
}

// Along an aisle, and round its end into the next one.
std::vector<SiteObject> PathOfLot(Random& random, double length,
                                  const std::vector<double>& aisles) {
  constexpr double kBeyond = 3;  // the rows [m]
  const double want = random.Uniform(kShortestPath, kLongestPath);
  auto aisle = static_cast<std::size_t>(random.Uniform() * static_cast<double>(aisles.size()));
  double x = random.Uniform() * std::max(0., length - 0.6 * want), direction = 1;
  std::vector<SiteObject> path;
  while (static_cast<double>(path.size()) < want) {
    path.push_back({"", x, aisles[aisle]});
    x += direction;
    if (x >= -kBeyond && x <= length + kBeyond) continue;
    direction = -direction;
    const std::size_t next = aisle + 1 < aisles.size() ? aisle + 1 : aisle > 0 ? aisle - 1 : aisle;
    const double step = aisles[next] > aisles[aisle] ? 1 : -1;
    for (double y = aisles[aisle]; (aisles[next] - y) * step > 0; y += step)
      path.push_back({"", x, y});
    aisle = next;
  }
  return path;
}

GeneratedSite MakeLot(Random& random, double count, bool same) {
  constexpr double kTaken = 0.6, kStall = 2.5, kAisle = 11, kBackToBack = 5.2;  // [m]
  const int columns = static_cast<int>(std::clamp(std::sqrt(kStall * count / kTaken), 12., 60.));
  const int rows = std::max(2, static_cast<int>(count / kTaken / columns));
  GeneratedSite site;
  std::vector<double> aisles;
  double y = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      if (random.Chance(kTaken))
        site.objects.push_back({same ? "Car" : DrawVehicle(random),
                                kStall * column + random.Normal(0, 0.15),
                                y + random.Normal(0, 0.25)});
    if (row % 2 == 0 && row + 1 < rows) aisles.push_back(y + kAisle / 2);
    y += row % 2 == 0 ? kAisle : kBackToBack;
  }
  site.path = PathOfLot(random, kStall * (columns - 1), aisles);
  return site;
}

// A winding line: a point and a heading for each metre.
class Line {
 public:
  Line(Random& random, double length) {
    double x = 0, y = 0, heading = 0, bend = 0;
    for (int metre = 0; metre < length; ++metre) {
      if (metre % 40 == 0) bend = random.Uniform(-0.012, 0.012);
      heading += bend;
      x += std::cos(heading), y += std::sin(heading);
      points_.push_back({x, y, heading});
    }
  }
  double length() const { return static_cast<double>(points_.size() - 1); }
  SiteObject Beside(double along, double left, const std::string& label) const {
    const auto metre = std::min(static_cast<std::size_t>(along), points_.size() - 1);
    const auto& [x, y, heading] = points_[metre];
    const double rest = along - static_cast<double>(metre);
    return {label, x + rest * std::cos(heading) - left * std::sin(heading),
            y + rest * std::sin(heading) + left * std::cos(heading)};
  }

 private:
  struct Point {
    double x, y, heading;
  };
  std::vector<Point> points_;
};

GeneratedSite MakeStreet(Random& random, double count) {
  constexpr double kPerMetre = 2 / 7.9 + 2 / 30.;  // objects
  const Line line(random, count / kPerMetre);
  GeneratedSite site;
  for (const double side : {-1., 1.}) {
    for (double at = random.Uniform(0, 8); at < line.length();
         at += 4.9 - 3 * std::log(1 - random.Uniform()))
      site.objects.push_back(
          line.Beside(at, 5 * side + random.Normal(0, 0.25), DrawVehicle(random)));
    for (double at = random.Uniform(0, 30); at < line.length(); at += random.Uniform(20, 40))
      site.objects.push_back(line.Beside(at, 7.5 * side + random.Normal(0, 0.3),
                                         random.Chance(0.6) ? "Pole" : "Tree"));
  }
  const double want = random.Uniform(kShortestPath, kLongestPath);
  const double from = random.Uniform() * std::max(0., line.length() - want);
  const double lane = random.Chance(0.5) ? -2 : 2;
  for (double at = from; at < std::min(from + want, line.length()); ++at)
    site.path.push_back(line.Beside(at, lane, ""));
  return site;
}

GeneratedSite MakeTrees(Random& random, double count) {
  const double density = std::exp(random.Uniform(std::log(0.006), std::log(0.03)));  // [1/m^2]
  const double side = std::sqrt(count / density);
  GeneratedSite site;
  for (int i = 0; i < count; ++i)
    site.objects.push_back({"Tree", random.Uniform(0, side), random.Uniform(0, side)});
  const double want = random.Uniform(kShortestPath, kLongestPath), bend = random.Normal(0, 0.01);
  double x = random.Uniform(0.2, 0.8) * side, y = random.Uniform(0.2, 0.8) * side;
  double heading = std::atan2(side / 2 - y, side / 2 - x) + random.Normal(0, 0.5);
  for (int metre = 0; metre < want; ++metre) {
    site.path.push_back({"", x, y});
    heading += bend;
    x += std::cos(heading), y += std::sin(heading);
  }
  site.sight_m = 15;
  return site;
}

// Where the odometry has a point of the path, and how far its heading is off there.
struct OdometryPoint {
  double x = 0, y = 0, turn = 0;
};

std::vector<OdometryPoint> OdometryAlong(const std::vector<SiteObject>& path,
                                         const StretchNoise& noise, Random& random) {
  constexpr double kStep = 5e-4;  // of the heading, each metre [rad]
  const double scale = 1 + random.Normal(0, noise.scale);
  const double bend = random.Normal(0, noise.bend_rad_per_m);
  std::vector<OdometryPoint> points(1);
  points[0].turn = random.Uniform(-M_PI, M_PI);
  for (std::size_t i = 1; i < path.size(); ++i) {
    OdometryPoint next = points.back();
    const double dx = path[i].x - path[i - 1].x, dy = path[i].y - path[i - 1].y;
    next.turn += bend + random.Normal(0, kStep);
    next.x += scale * (std::cos(next.turn) * dx - std::sin(next.turn) * dy);
    next.y += scale * (std::sin(next.turn) * dx + std::cos(next.turn) * dy);
    points.push_back(next);
  }
  return points;
}

SiteCandidate TruthAt(const SiteObject& place, const OdometryPoint& odometry) {
  SiteCandidate truth;
  truth.yaw = -odometry.turn;
  const double c = std::cos(truth.yaw), s = std::sin(truth.yaw);
  truth.x = place.x - (c * odometry.x - s * odometry.y);
  truth.y = place.y - (s * odometry.x + c * odometry.y);
  return truth;
}

std::string OtherLabel(const std::string& label, Random& random) {
  if (label == "Tree") return "Pole";
  if (label == "Pole") return "Tree";
  return DrawVehicle(random);
}

}  // namespace

const std::vector<std::string> kSiteKinds = {"lot", "same", "street", "trees"};

GeneratedSite MakeSite(const std::string& kind, std::uint64_t seed) {
  Random random(seed, 1);
  const double count = std::exp(random.Uniform(std::log(100.), std::log(1000.)));
  if (kind == "lot" || kind == "same") return MakeLot(random, count, kind == "same");
  if (kind == "street") return MakeStreet(random, count);
  if (kind == "trees") return MakeTrees(random, count);
  throw Error(ErrorKind::kUsage, "no kind of site '" + kind + "'");
}

Site MapOfSite(const GeneratedSite& site, const std::string& name, std::uint64_t seed) {
  Random random(seed, 2);
  Site map{name, {}};
  for (const SiteObject& object : site.objects)
    if (random.Chance(0.95))
      map.objects.push_back(
          {object.label, object.x + random.Normal(0, 0.1), object.y + random.Normal(0, 0.1)});
  return map;
}

GeneratedStretch DriveThrough(const GeneratedSite& site, const StretchNoise& noise,
                              std::uint64_t seed) {
  Random random(seed, 3);
  const std::vector<OdometryPoint> odometry = OdometryAlong(site.path, noise, random);
  GeneratedStretch stretch;
  const auto add = [&](const std::string& label, std::size_t from, double dx, double dy) {
    const OdometryPoint& o = odometry[from];
    const double c = std::cos(o.turn), s = std::sin(o.turn);
    stretch.objects.push_back({label, o.x + c * dx - s * dy + random.Normal(0, noise.position_m),
                               o.y + s * dx + c * dy + random.Normal(0, noise.position_m)});
  };
  for (const SiteObject& object : site.objects) {
    const auto distance = [&](const SiteObject& point) {
      return std::hypot(object.x - point.x, object.y - point.y);
    };
    const auto nearest = std::min_element(
        site.path.begin(), site.path.end(),
        [&](const SiteObject& a, const SiteObject& b) { return distance(a) < distance(b); });
    if (distance(*nearest) > site.sight_m || random.Chance(noise.missed)) continue;
    const bool other = random.Chance(noise.other_label);
    add(other ? OtherLabel(object.label, random) : object.label,
        static_cast<std::size_t>(nearest - site.path.begin()), object.x - nearest->x,
        object.y - nearest->y);
  }
  const int more = random.Poisson(noise.false_ones * static_cast<double>(stretch.objects.size()));
  for (int i = 0; i < more; ++i) {
    const auto draw = [&](std::size_t size) {
      return static_cast<std::size_t>(random.Uniform() * static_cast<double>(size));
    };
    const std::string label = site.objects[draw(site.objects.size())].label;
    add(label, draw(site.path.size()), random.Uniform(-site.sight_m, site.sight_m),
        random.Uniform(-site.sight_m, site.sight_m));
  }
  stretch.truth = TruthAt(site.path[site.path.size() / 2], odometry[site.path.size() / 2]);
  return stretch;
}

}  // namespace sslcd
