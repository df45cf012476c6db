// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layout_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "formats/json.h"
#include "sslcd/core/error.h"

namespace sslcd::sim {
namespace {

double NumberOf(const JsonValue& car, const std::string& key) {
  const JsonValue& value = car.Child(key);
  if (value.kind != JsonValue::Kind::kNumber) value.Fail("'" + key + "' must be a number");
  return value.number;
}

/// Refuses unknown keys, since a misspelt key would be ignored silently.
void CheckKeys(const JsonValue& car) {
  static const std::set<std::string> kKnown{"x", "y", "z", "qx", "qy", "qz", "qw", "w", "label"};
  if (!car.IsObject()) car.Fail("expected a car as an object with keys x, y, z, qx, qy, qz, w");
  for (std::size_t i = 0; i < car.keys.size(); ++i) {
    if (kKnown.count(car.keys[i]) == 0)
      car.items[i].Fail("unknown key '" + car.keys[i] +
                        "': x, y, z, qx, qy, qz, w, label are known");
  }
}

std::string LabelOf(const JsonValue& car) {
  const JsonValue* label = car.Find("label");
  if (label == nullptr) return "";
  const std::string text = label->Text();
  if (text != "Car" && text != "Van" && text != "Truck")
    label->Fail("'label' must be Car, Van or Truck");
  return text;
}

Slot SlotOf(const JsonValue& car) {
  constexpr double kFar = 1e4;  // [m]
  CheckKeys(car);
  const double x = NumberOf(car, "x"), y = NumberOf(car, "y");
  if (std::max(std::abs(x), std::abs(y)) > kFar)
    car.Fail("the car stands more than 10 km from the origin");
  NumberOf(car, "z");
  const double qx = NumberOf(car, "qx"), qy = NumberOf(car, "qy"), qz = NumberOf(car, "qz");
  const double w = NumberOf(car, car.Find("qw") != nullptr ? "qw" : "w");
  if (std::abs(qx * qx + qy * qy + qz * qz + w * w - 1) > 0.02)
    car.Fail("'qx qy qz w' is no unit quaternion: its length must be 1");
  // Seen from above with the file's +y ahead, the file's yaw counts counter-clockwise from x, and a
  // heading clockwise from ahead.
  const double yaw = std::atan2(2 * (w * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
  return {x, y, 0.5 * M_PI - yaw, LabelOf(car)};
}

std::vector<Slot> ReadSlots(const std::string& path) {
  const JsonValue root = ReadJson(path);
  if (!root.IsList() || root.items.empty())
    root.Fail("expected a list of cars, [{\"x\": .., \"y\": .., \"qz\": .., \"w\": ..}, ...]");
  std::vector<Slot> slots;
  for (const JsonValue& car : root.items) slots.push_back(SlotOf(car));
  return slots;
}

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

/// The most frequent direction of the vehicles, modulo a right angle.
double Grain(const std::vector<Slot>& slots) {
  double sine = 0, cosine = 0;
  for (const Slot& slot : slots) {
    sine += std::sin(4 * slot.heading);
    cosine += std::cos(4 * slot.heading);
  }
  return 0.25 * std::atan2(sine, cosine);
}

/// The lot in the frame of an observer at (x, z) with this heading.
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
    box.left = std::min(box.left, p.x);
    box.right = std::max(box.right, p.x);
    box.back = std::min(box.back, p.z);
    box.front = std::max(box.front, p.z);
  }
  return box;
}

bool IsNear(const Slot& slot, const std::vector<Path::Point>& points) {
  constexpr double kNear = 14;  // [m] range within which a parked car is seen well. Set by hand.
  return std::any_of(points.begin(), points.end(), [&](const Path::Point& point) {
    return std::hypot(slot.x - point.x, slot.z - point.z) < kNear;
  });
}

/// Points of two parts of the course: the outward pass, and the last leg, which closes the loop.
struct Legs {
  std::vector<Path::Point> way_out, last_leg;
};

Legs LegsOf(const HalvCourse& course) {
  constexpr std::size_t kEvery = 5;  // uses every fifth point of the course
  Legs legs;
  for (std::size_t i = 0; i < course.points.size(); i += kEvery) {
    const double s =
        course.path.length() * static_cast<double>(i) / static_cast<double>(course.points.size());
    if (s < course.return_m) legs.way_out.push_back(course.points[i]);
    if (s > course.last_leg_m) legs.last_leg.push_back(course.points[i]);
  }
  return legs;
}

/// Number of cars seen from both legs minus the cars on the path.
int CountUseful(const std::vector<Slot>& placed, const HalvCourse& course, const Legs& legs) {
  int score = 0;
  for (const Slot& slot : placed) {
    if (!IsClear(slot, course.points)) {
      --score;
    } else if (IsNear(slot, legs.last_leg) && IsNear(slot, legs.way_out)) {
      ++score;
    }
  }
  return score;
}

/// The placement with most useful cars, over rotations by right angles and a grid of shifts; none
/// if no placement has any.
std::optional<std::vector<Slot>> SearchPlacement(const std::vector<Slot>& slots,
                                                 const HalvCourse& course, const Box& driven) {
  constexpr double kBeyond = 12;  // the course may leave the lot by this much [m]
  // Step of the grid [m] and largest number of steps along a side. A wider lot gets wider steps.
  constexpr double kGrid = 2, kMaxSteps = 150;
  const Legs legs = LegsOf(course);
  std::optional<std::vector<Slot>> best;
  int best_score = 0;
  const double grain = Grain(slots);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const std::vector<Slot> turned = SeenFrom(slots, 0, 0, grain + 0.5 * M_PI * quarter);
    const Box lot = BoxOf(turned);
    const double step =
        std::max(kGrid, std::max(lot.right - lot.left, lot.front - lot.back) / kMaxSteps);
    for (double x = lot.left - kBeyond - driven.left; x + driven.right <= lot.right + kBeyond;
         x += step) {
      for (double z = lot.back - kBeyond - driven.back; z + driven.front <= lot.front + kBeyond;
           z += step) {
        std::vector<Slot> placed = SeenFrom(turned, x, z, 0);
        const int score = CountUseful(placed, course, legs);
        if (score <= best_score) continue;
        best_score = score;
        best = std::move(placed);
      }
    }
  }
  return best;
}

[[noreturn]] void FailTooSmall(const Box& driven, const Box& lot) {
  const auto metres = [](double a, double b) {
    return std::to_string(static_cast<int>(std::lround(b - a)));
  };
  throw Error(ErrorKind::kUsage,
              "the path leaves the lot: it needs " + metres(driven.left, driven.right) + " m x " +
                  metres(driven.back, driven.front) + " m, the cars stand on " +
                  metres(lot.left, lot.right) + " m x " + metres(lot.back, lot.front) +
                  " m; take a smaller --size, another --case or another layout");
}

}  // namespace

LayoutFile ReadLayout(const std::string& path) {
  const std::vector<Slot> slots = ReadSlots(path);
  LayoutFile file{WithoutDoubles(slots, 0), 0};
  std::vector<Slot> across = WithoutDoubles(slots, 0.5 * M_PI);
  if (across.size() > file.slots.size()) file.slots = std::move(across);
  file.doubles = static_cast<int>(slots.size() - file.slots.size());
  return file;
}

PlacedLayout PlaceLayout(const std::vector<Slot>& slots, const HalvCourse& course) {
  const Box driven = BoxOf(course.points);
  const std::optional<std::vector<Slot>> placed = SearchPlacement(slots, course, driven);
  if (!placed) FailTooSmall(driven, BoxOf(slots));
  PlacedLayout result;
  for (const Slot& slot : *placed) {
    if (IsClear(slot, course.points)) {
      result.slots.push_back(slot);
    } else {
      ++result.in_the_way;
    }
  }
  return result;
}

}  // namespace sslcd::sim
