// SPDX-License-Identifier: BSD-3-Clause
#include "check/headings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "check/cuboid.h"
#include "check/world_headings.h"
#include "core/median.h"

namespace sslcd::check {
namespace {

constexpr std::size_t kLeastHeadings = 30;
constexpr int kLeastTurned = 30;
constexpr double kBeyondATurn = 2 * M_PI + 0.1, kDegreesShare = 0.1;
constexpr double kOneValue = 0.95;                       // share of rows
constexpr double kElongated = 0.15;                      // (l - w) / l of an object with a heading
constexpr double kAlphaOff = 0.35, kAlphaAgrees = 0.15;  // median [rad]
constexpr double kIouBetter = 0.05, kIouWorse = 0.02, kGoodIou = 0.55;
constexpr double kCameraTurn = 0.15, kTurnRatio = 0.5, kTurnOff = 0.2;  // [rad]

/// Another meaning of the column.
struct HeadingConvention {
  const char *id, *name;
  double (*heading)(const Row& row);  ///< what rotation_y should be
};
double Written(const Row& row) { return row.written.rotation_y; }
const HeadingConvention kGiven = {"", "as given", Written};
const HeadingConvention kOthers[] = {
    {"heading_sign", "the other sign", [](const Row& row) { return -Written(row); }},
    {"heading_quarter_turn", "a quarter turn more",
     [](const Row& row) { return Written(row) + M_PI / 2; }},
    {"heading_quarter_turn", "a quarter turn less",
     [](const Row& row) { return Written(row) - M_PI / 2; }},
    {"heading_half_turn", "half a turn more", [](const Row& row) { return Written(row) + M_PI; }},
    {"heading_axes", "the other sign and a quarter turn less",
     [](const Row& row) { return -Written(row) - M_PI / 2; }},
    {"heading_axes", "the other sign and a quarter turn more",
     [](const Row& row) { return -Written(row) + M_PI / 2; }},
    {"heading_is_alpha", "the bearing added",
     [](const Row& row) { return Written(row) + Bearing(row.detection); }}};

std::function<void(Sequence&)> Rewrite(double (*heading)(const Row& row)) {
  return [heading](Sequence& s) {
    for (Row& row : s.rows) {
      FileCuboid cuboid = ReadCuboid(row.detection);
      cuboid.rotation_y = WrapAngle(heading(row));
      WriteCuboid(cuboid, row);
    }
  };
}

/// What speaks for a meaning.
struct Support {
  std::optional<double> alpha;  ///< median error [rad]
  std::optional<double> iou;    ///< median, of elongated objects
  std::optional<double> turn;   ///< median change of the heading in the world [rad]
};

class HeadingJudge {
 public:
  explicit HeadingJudge(const Sequence& sequence) : elongated_(sequence) {
    auto& rows = elongated_.rows;
    rows.erase(std::remove_if(rows.begin(), rows.end(),
                              [&](const Row& row) {
                                const Vec3& dims = row.detection.dims;
                                return !HasHeading(sequence, row) ||
                                       std::abs(dims.x() - dims.y()) < kElongated * dims.x();
                              }),
               rows.end());
    has_alphas_ = HasAlphas(elongated_);
    if (!elongated_.has_odometry) return;
    if (const auto objects = FindStaticObjects(elongated_))
      for (const SameObject& same : SameObjects(elongated_, objects->pairs, objects->cap_m))
        if (std::abs(same.camera_turn) > kCameraTurn) turned_.push_back(same);
  }
  HeadingJudge(const HeadingJudge&) = delete;  // the pairs point to the rows

  const Sequence& elongated() const { return elongated_; }
  bool has_alphas() const { return has_alphas_; }
  int turned() const { return static_cast<int>(turned_.size()); }

  Support Of(const HeadingConvention& convention) const {
    Support support;
    if (has_alphas_) {
      std::vector<double> errors;
      for (const Row& row : elongated_.rows)
        errors.push_back(std::abs(
            WrapAngle(row.written.alpha - convention.heading(row) + Bearing(row.detection))));
      support.alpha = Median(std::move(errors));
    }
    support.iou = MedianIou(elongated_, [&](Row& row, Camera&) {
      FileCuboid cuboid = ReadCuboid(row.detection);
      cuboid.rotation_y = WrapAngle(convention.heading(row));
      WriteCuboid(cuboid, row);
    });
    if (turned() >= kLeastTurned) {
      std::vector<double> turns;
      for (const SameObject& same : turned_)
        turns.push_back(std::abs(
            WorldTurn(same, convention.heading(*same.before), convention.heading(*same.after))));
      support.turn = Median(std::move(turns));
    }
    return support;
  }

 private:
  Sequence elongated_;
  bool has_alphas_ = false;
  std::vector<SameObject> turned_;
};

std::string Text(const Support& s) {
  std::string text;
  if (s.alpha) text += ", alpha is off by " + Figure(*s.alpha) + " rad";
  if (s.iou) text += ", cuboids fill their 2D boxes to " + Percent(*s.iou);
  if (s.turn) text += ", headings turn by " + Figure(*s.turn) + " rad with the camera";
  return text.empty() ? "nothing to compare with" : text.substr(2);
}

/// Whether one of the witnesses asks for the other meaning, and none against it.
bool IsBetter(const Support& other, const Support& given) {
  const bool by_alpha = given.alpha && *given.alpha > kAlphaOff && *other.alpha < kAlphaAgrees;
  const bool by_iou = given.iou && *other.iou > *given.iou + kIouBetter && *other.iou > kGoodIou;
  const bool by_turn =
      given.turn && *given.turn > kTurnOff && *other.turn < kTurnRatio * *given.turn;
  const bool against = (given.alpha && *other.alpha > *given.alpha + kAlphaAgrees) ||
                       (given.iou && *other.iou < *given.iou - kIouWorse) ||
                       (given.turn && *other.turn > *given.turn + 0.5 * kTurnOff);
  return (by_alpha || by_iou || by_turn) && !against;
}

double Rank(const Support& s) {
  return s.alpha.value_or(0) - s.iou.value_or(0) + s.turn.value_or(0);
}

}  // namespace

Outcome CheckHeadings(const Sequence& sequence) {
  const HeadingJudge judge(sequence);
  const std::vector<Row>& rows = judge.elongated().rows;
  if (rows.size() < kLeastHeadings)
    return NotTestable("fewer than " + std::to_string(kLeastHeadings) +
                       " elongated objects whose label has a heading");
  const auto count = static_cast<double>(rows.size());
  const auto share = [&](auto condition) {
    return static_cast<double>(std::count_if(rows.begin(), rows.end(), condition)) / count;
  };
  const double beyond = share([](const Row& row) { return std::abs(Written(row)) > kBeyondATurn; });
  if (beyond > kDegreesShare)
    return Found("heading_degrees",
                 Percent(beyond) + " of the headings are beyond a turn in rad: degrees",
                 Rewrite([](const Row& row) { return Written(row) * M_PI / 180; }));
  std::map<double, int> values;
  for (const Row& row : rows) ++values[Written(row)];
  const int most = std::max_element(values.begin(), values.end(), [](auto& a, auto& b) {
                     return a.second < b.second;
                   })->second;
  if (most > kOneValue * count) {
    if (judge.has_alphas())
      return Found(
          "no_heading", Percent(most / count) + " of the headings are the same, but alpha varies",
          Rewrite([](const Row& row) { return row.written.alpha + Bearing(row.detection); }));
    if (judge.turned() >= kLeastTurned)
      return Found("no_heading", Percent(most / count) +
                                     " of the headings are the same, though the camera turns");
    return NotTestable("all headings are the same, and the camera does not turn");
  }
  const Support given = judge.Of(kGiven);
  const HeadingConvention* best = nullptr;
  Support of_best;
  for (const HeadingConvention& other : kOthers) {
    const Support support = judge.Of(other);
    if (!IsBetter(support, given) || (best && Rank(support) >= Rank(of_best))) continue;
    best = &other;
    of_best = support;
  }
  if (!best) return Ok(Text(given));
  return Found(best->id, Text(given) + "; with " + best->name + ": " + Text(of_best),
               Rewrite(best->heading));
}

}  // namespace sslcd::check
