// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
#include "render/ground.h"

#include "render/noise.h"

namespace sslcd::render {
namespace {

constexpr float kPavedWithin = 9;  // distance from the used places [m]
constexpr float kHalfLine = 0.055f;

/// Factor of rectangles of newer or older asphalt in some cells of a coarse grid, with sealed
/// edges.
float Repaired(const Vec2f& place, std::uint32_t seed, float footprint) {
  const Vec2f cell(9, 7);
  const Vec2f at = place.cwiseQuotient(cell);
  const std::uint32_t patch = Hash(Floor(at.x()), Floor(at.y()), seed);
  if (patch % 3 != 0) return 1;
  const Vec2f off = Vec2f(Fraction(at.x()) - 0.5f, Fraction(at.y()) - 0.5f).cwiseProduct(cell);
  const Vec2f half{Mix(0.6f, 3, Unit(Hash(patch))), Mix(0.5f, 2, Unit(Hash(patch, 1)))};
  const float inside = (half - off.cwiseAbs()).minCoeff();
  const float shade = inside > 0 ? Mix(0.55f, 1.25f, Unit(Hash(patch, 2))) : 1;
  return shade * (1 - 0.7f * Band(inside, 0.03f, footprint));
}

/// Factor of cracks along some borders of distorted cells.
float Cracked(const Vec2f& place, float bend, std::uint32_t seed, float footprint) {
  constexpr float kCells = 0.22f;  // per metre
  const float open =
      Smooth(-0.1f, 0.35f, Fractal(place.x(), place.y(), seed + 1, {0.12f, 2}, footprint));
  if (open <= 0) return 1;
  const Vec2f bent = kCells * place + 0.3f * bend * Vec2f(1, -1);
  const float crack = CellNoise(bent.x(), bent.y(), seed).border / kCells;
  return 1 - 0.75f * open * Band(crack, 0.02f, footprint);
}

/// A leaf, a stone or a spot of chewing gum in every second cell.
Vec3f Littered(const Vec2f& place, std::uint32_t seed, float footprint, const Vec3f& asphalt) {
  constexpr float kCell = 0.55f;
  const Vec2f at = place / kCell;
  const std::uint32_t thing = Hash(Floor(at.x()), Floor(at.y()), seed);
  const Vec2f middle{Mix(0.2f, 0.8f, Unit(Hash(thing, 1))), Mix(0.2f, 0.8f, Unit(Hash(thing, 2)))};
  const float off = kCell * (Vec2f(Fraction(at.x()), Fraction(at.y())) - middle).norm();
  if (thing % 2 == 0 || off > 0.05f + footprint) return asphalt;
  static const Vec3f kColours[] = {
      {0.03f, 0.03f, 0.03f}, {0.2f, 0.13f, 0.05f}, {0.3f, 0.29f, 0.27f}, {0.05f, 0.05f, 0.05f}};
  const float ragged = 0.6f + 0.8f * ValueNoise(60 * place.x(), 60 * place.y(), seed);
  const float size = ragged * Mix(0.008f, 0.03f, Unit(Hash(thing, 3)));
  return Mix(asphalt, kColours[thing / 2 % 4], 0.8f * Band(off, size, footprint));
}

}  // namespace

GridIndex::GridIndex(const Vec2f& low, const Vec2f& high, float cell) : low_(low), cell_(cell) {
  columns_ = 1 + static_cast<int>((high.x() - low.x()) / cell);
  rows_ = 1 + static_cast<int>((high.y() - low.y()) / cell);
  lists_.resize(static_cast<std::size_t>(columns_) * rows_);
}

void GridIndex::Add(const Vec2f& low, const Vec2f& high, int number) {
  const auto cell = [&](float from, float to, int count) {
    return std::clamp(Floor((to - from) / cell_), 0, count - 1);
  };
  for (int row = cell(low_.y(), low.y(), rows_); row <= cell(low_.y(), high.y(), rows_); ++row) {
    for (int column = cell(low_.x(), low.x(), columns_);
         column <= cell(low_.x(), high.x(), columns_); ++column)
      lists_[static_cast<std::size_t>(row) * columns_ + column].push_back(number);
  }
}

const std::vector<int>& GridIndex::At(const Vec2f& place) const {
  static const std::vector<int> kNone;
  const float column = (place.x() - low_.x()) / cell_, row = (place.y() - low_.y()) / cell_;
  if (!(column >= 0 && row >= 0 && column < static_cast<float>(columns_) &&
        row < static_cast<float>(rows_)))
    return kNone;
  return lists_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
}

Ground::Ground(const sim::HalvWorld& scene, const UsedArea& used, std::uint32_t seed)
    : seed_(seed) {
  const Vec2f margin = Vec2f::Constant(2 * kPavedWithin), low = used.low - margin,
              high = used.high + margin;
  near_lines_ = near_oil_ = GridIndex(low, high, 2);
  near_used_ = GridIndex(low, high, 2);
  const auto add_line = [&](const Vec2f& from, const Vec2f& to) {
    const Vec2f half = Vec2f::Constant(2 * kHalfLine + 0.2f);
    near_lines_.Add(from.cwiseMin(to) - half, from.cwiseMax(to) + half,
                    static_cast<int>(lines_.size()));
    lines_.push_back({from, to});
  };
  for (const sim::ParkingSpace& space : scene.spaces) {
    const float heading = static_cast<float>(space.heading);
    const Vec2f centre(static_cast<float>(space.x), static_cast<float>(space.z));
    const Vec2f ahead(std::sin(heading), std::cos(heading)), right(ahead.y(), -ahead.x());
    const Vec2f front = 0.5f * static_cast<float>(space.length_m) * ahead;
    const Vec2f side = 0.5f * static_cast<float>(space.width_m) * right;
    add_line(centre - front - side, centre + front - side);
    add_line(centre - front + side, centre + front + side);
    add_line(centre + front - side, centre + front + side);
    if (Unit(Hash(seed, static_cast<std::uint32_t>(oil_.size()))) < 0.9f) {
      const Vec2f drop = centre + 0.35f * front;
      near_oil_.Add(drop - Vec2f::Constant(0.7f), drop + Vec2f::Constant(0.7f),
                    static_cast<int>(oil_.size()));
      oil_.push_back(drop);
    }
  }
  for (const Vec2f& place : used.places) {  // a few of the many close places are enough
    const std::vector<int>& others = near_used_.At(place);
    if (std::any_of(others.begin(), others.end(),
                    [&](int i) { return (used_[i] - place).norm() < 1.5f; }))
      continue;
    const Vec2f reach = Vec2f::Constant(kPavedWithin + 1);
    near_used_.Add(place - reach, place + reach, static_cast<int>(used_.size()));
    used_.push_back(place);
  }
}

float Ground::PavedShare(const Vec2f& place) const {
  float nearest = 2 * kPavedWithin;
  for (int i : near_used_.At(place)) {
    nearest = std::min(nearest, (used_[i] - place).norm());
    if (nearest < kPavedWithin - 1) return 1;
  }
  const float ragged = 0.5f * Fractal(place.x(), place.y(), seed_ + 3, {1, 3}, 0);
  return 1 - Smooth(kPavedWithin - 0.1f, kPavedWithin + 0.1f, nearest + ragged);
}

float Ground::PaintedShare(const Vec2f& place, float footprint) const {
  float painted = 0;
  for (int i : near_lines_.At(place)) {
    const Line& line = lines_[i];
    const Vec2f way = line.to - line.from;
    const float along = Clamp01((place - line.from).dot(way) / way.squaredNorm());
    painted =
        std::max(painted, Band((place - line.from - along * way).norm(), kHalfLine, footprint));
  }
  if (painted <= 0) return 0;
  const float worn = Fractal(place.x(), place.y(), seed_ + 9, {1.3f, 6}, footprint);
  return painted * (0.85f - 0.75f * Smooth(0.05f, 0.7f, worn));
}

Vec3f Ground::Asphalt(const Vec2f& place, float footprint) const {
  const float x = place.x(), y = place.y();
  const float wide = Fractal(x, y, seed_, {0.07f, 3}, footprint);
  const float middle = Fractal(x, y, seed_ + 1, {0.8f, 5, 0.75f}, footprint);
  const float grain = Fractal(x, y, seed_ + 2, {28, 3, 0.8f}, footprint);
  float grey = 0.125f * (1 + 0.3f * wide + 0.26f * middle + 0.34f * grain);
  const float stones = Clamp01(1.5f - 90 * footprint);  // share of stones, visible from nearby
  if (stones > 0) {
    const float speck = ValueNoise(x * 60, y * 60, seed_ + 4);
    grey += stones * (0.08f * Smooth(0.8f, 0.95f, speck) - 0.04f * Smooth(0.2f, 0.05f, speck));
  }
  grey *=
      Repaired(place, seed_ + 5, footprint) * Cracked(place, 0.1f * middle, seed_ + 6, footprint);
  float oil = 0;
  for (int i : near_oil_.At(place)) {
    const float edge = (oil_[i] - place).norm() + 0.25f * middle;
    oil = std::max(oil,
                   Smooth(0.5f, 0.1f, edge) * Unit(Hash(seed_ + 8, static_cast<std::uint32_t>(i))));
  }
  grey = std::max(grey * (1 - 0.6f * oil), 0.012f);
  return Littered(place, seed_ + 11, footprint, grey * Vec3f(1.02f, 1, 0.97f));
}

Surface Ground::At(const SurfacePoint& point) const {
  const Vec2f place = point.position.head<2>();
  const float paved = PavedShare(place);
  Surface surface;
  surface.kind = 0;
  if (paved > 0) {
    surface.albedo = Asphalt(place, point.footprint);
    surface.albedo =
        Mix(surface.albedo, Vec3f(0.62f, 0.62f, 0.6f), PaintedShare(place, point.footprint));
  }
  if (paved < 1) {
    const float tuft = Fractal(place.x(), place.y(), seed_ + 10, {0.3f, 8}, point.footprint);
    const Vec3f grass =
        Mix(Vec3f(0.06f, 0.1f, 0.025f), Vec3f(0.16f, 0.16f, 0.07f), Clamp01(0.45f + 0.5f * tuft));
    surface.albedo = Mix(grass, surface.albedo, paved);
  }
  return surface;
}

}  // namespace sslcd::render
