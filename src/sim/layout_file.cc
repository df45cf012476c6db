// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layout_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "sslcd/core/error.h"
#include "sslcd/io/text_rows.h"

namespace sslcd::sim {
namespace {

// Every JSON file is a YAML file; yaml-cpp tells the line.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  std::vector<Slot> Read() const {
    YAML::Node root;
    try {
      root = YAML::Load(ReadFileBytes(path_));
    } catch (const YAML::Exception& error) {
      throw Error(ErrorKind::kBadInput, {path_, error.mark.line + 1, 0}, error.msg);
    }
    if (!root.IsSequence() || root.size() == 0)
      Fail(root, "expected a list of cars, [{\"x\": .., \"y\": .., \"qz\": .., \"w\": ..}, ...]");
    std::vector<Slot> slots;
    for (const YAML::Node& node : root) slots.push_back(Car(node));
    return slots;
  }

 private:
  [[noreturn]] void Fail(const YAML::Node& at, const std::string& message) const {
    const YAML::Mark mark = at.Mark();
    throw Error(ErrorKind::kBadInput, {path_, mark.is_null() ? 0 : mark.line + 1, 0}, message);
  }

  double Number(const YAML::Node& car, const std::string& key) const {
    const YAML::Node node = car[key];
    if (!node.IsDefined()) Fail(car, "key '" + key + "' is missing");
    const auto number = node.IsScalar() ? ParseNumber(node.Scalar()) : std::nullopt;
    if (!number || !std::isfinite(*number)) Fail(node, "'" + key + "' must be a number");
    return *number;
  }

  // Misspelt keys and repeated ones, which yaml-cpp passes over in silence.
  void CheckKeys(const YAML::Node& car) const {
    static const std::set<std::string> kKnown{"x", "y", "z", "qx", "qy", "qz", "qw", "w", "label"};
    if (!car.IsMap()) Fail(car, "expected a car as an object with keys x, y, z, qx, qy, qz, w");
    std::set<std::string> seen;
    for (const auto& entry : car) {
      const std::string key = entry.first.Scalar();
      if (kKnown.count(key) == 0)
        Fail(entry.first, "unknown key '" + key + "': x, y, z, qx, qy, qz, w, label are known");
      if (!seen.insert(key).second) Fail(entry.first, "key '" + key + "' stands here twice");
    }
  }

  Slot Car(const YAML::Node& node) const {
    constexpr double kFar = 1e4;  // [m]
    CheckKeys(node);
    const double x = Number(node, "x"), y = Number(node, "y");
    if (std::max(std::abs(x), std::abs(y)) > kFar)
      Fail(node, "the car stands more than 10 km from the origin");
    Number(node, "z");
    const double qx = Number(node, "qx"), qy = Number(node, "qy"), qz = Number(node, "qz");
    const double w = Number(node, node["qw"].IsDefined() ? "qw" : "w");
    if (std::abs(qx * qx + qy * qy + qz * qz + w * w - 1) > 0.02)
      Fail(node, "'qx qy qz w' is no unit quaternion: its length must be 1");
    std::string label;
    if (const YAML::Node given = node["label"]) {
      label = given.IsScalar() ? given.Scalar() : "";
      if (label != "Car" && label != "Van" && label != "Truck")
        Fail(given, "'label' must be Car, Van or Truck");
    }
    // Seen from above with +y of the file ahead: its yaw counts from x against the clock, a heading
    // from ahead with it.
    const double yaw = std::atan2(2 * (w * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
    return {x, y, 0.5 * M_PI - yaw, label};
  }

  std::string path_;
};

std::vector<Slot> WithoutDoubles(const std::vector<Slot>& slots, double turn_rad) {
  std::vector<Slot> kept;
  for (Slot slot : slots) {
    slot.heading += turn_rad;
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const Slot& other) { return Overlap(slot, other); }))
      kept.push_back(slot);
  }
  return kept;
}

/// The direction most vehicles keep to, modulo a right angle.
double Grain(const std::vector<Slot>& slots) {
  double sine = 0, cosine = 0;
  for (const Slot& slot : slots)
    sine += std::sin(4 * slot.heading), cosine += std::cos(4 * slot.heading);
  return 0.25 * std::atan2(sine, cosine);
}

/// The lot seen by someone at (x, z) who looks towards `heading`.
std::vector<Slot> SeenFrom(const std::vector<Slot>& slots, double x, double z, double heading) {
  const double sine = std::sin(heading), cosine = std::cos(heading);
  std::vector<Slot> seen = slots;
  for (Slot& slot : seen) {
    const double dx = slot.x - x, dz = slot.z - z;
    slot.x = dx * cosine - dz * sine;
    slot.z = dx * sine + dz * cosine;
    slot.heading -= heading;
  }
  return seen;
}

struct Box {
  double left = INFINITY, right = -INFINITY, back = INFINITY, front = -INFINITY;
};

template <class Places>
Box BoxOf(const Places& places) {
  Box box;
  for (const auto& p : places) {
    box.left = std::min(box.left, p.x), box.right = std::max(box.right, p.x);
    box.back = std::min(box.back, p.z), box.front = std::max(box.front, p.z);
  }
  return box;
}

bool Near(const Slot& slot, const std::vector<Path::Point>& points) {
  constexpr double kNear = 14;
  return std::any_of(points.begin(), points.end(), [&](const Path::Point& point) {
    return std::hypot(slot.x - point.x, slot.z - point.z) < kNear;
  });
}

}  // namespace

LayoutFile ReadLayout(const std::string& path) {
  const std::vector<Slot> slots = Reader(path).Read();
  LayoutFile file{WithoutDoubles(slots, 0), 0};
  std::vector<Slot> across = WithoutDoubles(slots, 0.5 * M_PI);
  if (across.size() > file.slots.size()) file.slots = std::move(across);
  file.doubles = static_cast<int>(slots.size() - file.slots.size());
  return file;
}

PlacedLayout PlaceLayout(const std::vector<Slot>& slots, const HalvCourse& course) {
  constexpr double kBeyond = 12;  // the course may leave the lot by so much
  // metres, coarser where the lot is wider than so many steps
  constexpr double kGrid = 2, kSteps = 150;
  constexpr std::size_t kEvery = 5;  // of the course's points
  std::vector<Path::Point> way_out, last_leg;
  for (std::size_t i = 0; i < course.points.size(); i += kEvery) {
    const double s =
        course.path.length() * static_cast<double>(i) / static_cast<double>(course.points.size());
    if (s < course.return_m) way_out.push_back(course.points[i]);
    if (s > course.last_leg_m) last_leg.push_back(course.points[i]);
  }
  const Box driven = BoxOf(course.points);

  std::optional<std::vector<Slot>> best;
  int best_score = 0;
  const double grain = Grain(slots);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const std::vector<Slot> turned = SeenFrom(slots, 0, 0, grain + 0.5 * M_PI * quarter);
    const Box lot = BoxOf(turned);
    const double step =
        std::max(kGrid, std::max(lot.right - lot.left, lot.front - lot.back) / kSteps);
    for (double x = lot.left - kBeyond - driven.left; x + driven.right <= lot.right + kBeyond;
         x += step) {
      for (double z = lot.back - kBeyond - driven.back; z + driven.front <= lot.front + kBeyond;
           z += step) {
        std::vector<Slot> placed = SeenFrom(turned, x, z, 0);
        int score = 0;
        for (const Slot& slot : placed) {
          if (!IsClear(slot, course.points)) {
            --score;
          } else if (Near(slot, last_leg) && Near(slot, way_out)) {
            ++score;
          }
        }
        if (score <= best_score) continue;
        best_score = score;
        best = std::move(placed);
      }
    }
  }
  if (!best) {
    const Box lot = BoxOf(slots);
    const auto metres = [](double a, double b) {
      return std::to_string(static_cast<int>(std::lround(b - a)));
    };
    throw Error(ErrorKind::kUsage,
                "the path leaves the lot: it needs " + metres(driven.left, driven.right) + " m x " +
                    metres(driven.back, driven.front) + " m, the cars stand on " +
                    metres(lot.left, lot.right) + " m x " + metres(lot.back, lot.front) +
                    " m; take a smaller --size, another --case or another layout");
  }
  PlacedLayout result;
  for (const Slot& slot : *best) {
    if (IsClear(slot, course.points)) {
      result.slots.push_back(slot);
    } else {
      ++result.in_the_way;
    }
  }
  return result;
}

}  // namespace sslcd::sim
