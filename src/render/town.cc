// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
#include "render/town.h"

#include "render/noise.h"

namespace sslcd::render {
namespace {

constexpr float kAround = 7;   // from the used area to the wall [m]
constexpr float kGrid = 17;    // grid of the houses [m]
constexpr float kBeyond = 75;  // extent of the grid beyond the wall [m]

bool IsFree(const std::vector<Vec2f>& used, const Vec2f& low, const Vec2f& high, float clearance) {
  return std::none_of(used.begin(), used.end(), [&](const Vec2f& place) {
    return (place - place.cwiseMax(low).cwiseMin(high)).norm() < clearance;
  });
}

Building Box(const Vec2f& low, const Vec2f& high, float height, std::uint32_t seed, bool wall) {
  return {{low.x(), low.y(), 0}, {high.x(), high.y(), height}, seed, wall};
}

void AddWall(const std::vector<Vec2f>& used, const Vec2f& low, const Vec2f& high,
             std::uint32_t seed, Town& town) {
  constexpr float kPiece = 4, kThick = 0.3f, kGap = 3.5f;
  const auto add = [&](const Vec2f& from, const Vec2f& to) {
    if (IsFree(used, from, to, kGap)) town.buildings.push_back(Box(from, to, 1.9f, seed, true));
  };
  for (float x = low.x(); x < high.x(); x += kPiece) {
    const float end = std::min(x + kPiece, high.x());
    add({x, low.y() - kThick}, {end, low.y()});
    add({x, high.y()}, {end, high.y() + kThick});
  }
  for (float y = low.y(); y < high.y(); y += kPiece) {
    const float end = std::min(y + kPiece, high.y());
    add({low.x() - kThick, y}, {low.x(), end});
    add({high.x(), y}, {high.x() + kThick, end});
  }
}

/// A wall in running bond: mortar between bricks of 25 x 8 cm, each of another shade.
Vec3f Brick(float along, float up, std::uint32_t seed, const Vec3f& colour, float footprint) {
  const int row = Floor(up / 0.08f);
  const float shifted = along / 0.25f + (row % 2 == 0 ? 0 : 0.5f);
  const float shade = Unit(Hash(Floor(shifted), row, seed));
  const float fine = Clamp01(1.5f - 10 * footprint);
  const float joint = Band((Fraction(up / 0.08f) - 0.5f) * 0.08f, 0.034f, footprint) *
                      Band((Fraction(shifted) - 0.5f) * 0.25f, 0.119f, footprint);
  const Vec3f stone = colour * (0.75f + 0.5f * shade * fine + 0.25f * (1 - fine));
  return Mix(Vec3f(0.3f, 0.28f, 0.26f), stone, joint);
}

Vec3f Plain(std::uint32_t seed) {
  static const Vec3f kColours[] = {{0.34f, 0.12f, 0.08f}, {0.42f, 0.22f, 0.13f},
                                   {0.55f, 0.5f, 0.4f},   {0.45f, 0.45f, 0.44f},
                                   {0.6f, 0.57f, 0.5f},   {0.36f, 0.3f, 0.24f}};
  return kColours[seed % 6] * (0.85f + 0.3f * Unit(Hash(seed, 5)));
}

/// Storeys of windows in frames, with curtains, a plinth and doors.
Surface House(const Building& house, float along, float up, const SurfacePoint& point,
              std::uint32_t face) {
  const std::uint32_t seed = house.seed;
  const float pitch = Mix(2.2f, 3.6f, Unit(Hash(seed, 1))),
              storey = Mix(2.9f, 3.6f, Unit(Hash(seed, 2)));
  const int column = Floor(along / pitch), row = Floor(up / storey);
  const float u = along - (static_cast<float>(column) + 0.5f) * pitch;
  const float v = up - (static_cast<float>(row) + 0.52f) * storey;
  const float half_u = pitch * Mix(0.2f, 0.38f, Unit(Hash(seed, 3))),
              half_v = storey * Mix(0.22f, 0.32f, Unit(Hash(seed, 4)));
  const std::uint32_t window = Hash(column, row, seed + face);
  const float roof = house.high.z() - up;
  const bool opening =
      std::abs(u) < half_u && std::abs(v) < half_v && roof > 0.7f && Unit(window) < 0.9f;
  const float edge = std::min(half_u - std::abs(u), half_v - std::abs(v));
  if (opening && edge < 0.07f) return {Vec3f::Constant(0.6f), 0.01f, 10, 2};
  if (opening) {
    if (std::abs(u) < 0.03f) return {Vec3f::Constant(0.6f), 0.01f, 10, 2};
    const bool curtain =
        Unit(Hash(window, 1)) < 0.4f && (v > half_v * (2 * Unit(Hash(window, 2)) - 1));
    const Vec3f inside =
        curtain ? Vec3f(0.4f, 0.38f, 0.34f) *
                      (0.6f + 0.4f * std::sin(u * 40) * Clamp01(1 - 20 * point.footprint))
                : Vec3f(0.02f, 0.025f, 0.03f);
    return {inside, 0.1f, 900, curtain ? 4 : 3, 1};
  }
  const float stain = Fractal(along, 0.5f * up, seed, {0.4f, 6}, point.footprint);
  const bool brick = Hash(seed, 6) % 3 != 0;
  Vec3f albedo = brick ? Brick(along, up, seed, Plain(seed), point.footprint) : Plain(seed);
  if (up < 0.6f || roof < 0.35f || (roof < 1 && roof > 0.85f)) albedo = Vec3f(0.35f, 0.34f, 0.33f);
  const int band = up < 0.6f ? 5 : roof < 0.35f ? 6 : 1;
  return {Vec3f(albedo * (1 + 0.22f * stain)).cwiseMin(0.85f), 0, 1, band,
          Mix(0.6f, 1, Smooth(0, 2.5f, up))};
}

}  // namespace

Pose SceneFromWorld(const sim::World& world) {
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return Pose(lie::SO3<double>::FromMatrix(axes), Vec3(0, 0, world.camera_height_m));
}

UsedArea FindUsedArea(const sim::World& world) {
  UsedArea used;
  const auto add = [&](const Pose& pose) {
    const Vec3f at = pose.translation().cast<float>();
    used.places.emplace_back(at.x(), at.z());
  };
  for (const sim::WorldObject& object : world.objects) {
    if (!object.driving()) add(object.PoseAt(0));
  }
  for (const Pose& pose : world.truth.poses) add(pose);
  used.low = used.high = used.places.at(0);
  for (const Vec2f& place : used.places) {
    used.low = used.low.cwiseMin(place);
    used.high = used.high.cwiseMax(place);
  }
  for (const sim::WorldObject& object : world.objects) {
    if (!object.driving()) continue;
    for (const Pose& pose : object.T_world_object) add(pose);
  }
  return used;
}

Town MakeTown(const UsedArea& used, std::uint32_t seed) {
  Town town;
  const Vec2f low = used.low - Vec2f::Constant(kAround),
              high = used.high + Vec2f::Constant(kAround);
  AddWall(used.places, low, high, seed, town);
  int number = 0;
  for (float x = low.x() - kBeyond; x < high.x() + kBeyond; x += kGrid) {
    for (float y = low.y() - kBeyond; y < high.y() + kBeyond; y += kGrid) {
      const std::uint32_t house = Hash(seed, ++number);
      Draws draw(house);
      const Vec2f from{x + draw(0, 3), y + draw(0, 3)},
          to{from.x() + draw(9, 14), from.y() + draw(9, 14)};
      const bool on_wall = to.x() > low.x() - 3 && from.x() < high.x() + 3 &&
                           to.y() > low.y() - 3 && from.y() < high.y() + 3 &&
                           !(from.x() > low.x() + 3 && to.x() < high.x() - 3 &&
                             from.y() > low.y() + 3 && to.y() < high.y() - 3);
      if (on_wall || !IsFree(used.places, from, to, 8)) continue;
      if (draw(0, 1) < 0.3f) {
        for (int tree = 0; tree < 4; ++tree)
          town.trees.push_back(Vec2f{draw(from.x(), to.x()), draw(from.y(), to.y())});
      } else {
        town.buildings.push_back(
            Box(from, to, draw(0, 1) < 0.3f ? draw(10, 22) : draw(4, 10), house, false));
      }
    }
  }
  return town;
}

Mesh MakeTownMesh(const Town& town) {
  Mesh mesh;
  for (std::size_t i = 0; i < town.buildings.size(); ++i) {
    AddBox(mesh, town.buildings[i].low, town.buildings[i].high, static_cast<int>(i));
  }
  ComputeNormals(mesh);
  return mesh;
}

Surface TownSurface(const Town& town, const SurfacePoint& point) {
  const Building& building = town.buildings[point.part];
  if (point.normal.z() > 0.5f) return {Vec3f(0.3f, 0.29f, 0.28f), 0, 1, 9};
  const bool along_x = std::abs(point.normal.y()) > 0.5f;
  const float along = along_x ? point.position.x() : point.position.y();
  const std::uint32_t face = (along_x ? 2 : 0) + (point.normal.x() + point.normal.y() > 0);
  if (!building.wall) return House(building, along, point.position.z(), point, face);
  const float stain =
      Fractal(along, 0.6f * point.position.z(), building.seed, {0.5f, 6}, point.footprint);
  const bool coping = point.position.z() > 1.8f;
  const Vec3f albedo = coping ? Vec3f(0.4f, 0.39f, 0.37f)
                              : Brick(along, point.position.z(), building.seed,
                                      Vec3f(0.36f, 0.16f, 0.1f), point.footprint);
  return {Vec3f(albedo * (1 + 0.3f * stain)), 0, 1, coping ? 8 : 7,
          Mix(0.6f, 1, Smooth(0, 0.8f, point.position.z()))};
}

}  // namespace sslcd::render
