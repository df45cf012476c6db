// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
// The body is a loft: a surface through cross-sections along the car.
#include <utility>

#include "render/car_shape.h"

namespace sslcd::render {
namespace {

// rows of the section up to this one are the sides, the others are bonnet, roof and boot
constexpr int kTopRow = 8;

/// Left half of a cross-section, from below the sill to the middle of the roof: y, z.
std::vector<Vec2f> Section(const CarShape& shape, float x) {
  const float top = shape.Top(x), bottom = std::min(shape.Bottom(x), top - 0.03f);
  const float belt = std::max(std::min(shape.belt, top - 0.025f), bottom + 0.015f);
  const float side = shape.HalfWidth(x), roof = shape.HalfTop(x);
  const float shoulder = std::min(0.945f * side, std::max(roof + 0.03f, 0.945f * side));
  const auto door = [&](float up) { return Mix(bottom, belt, up); };
  const auto glass = [&](float up) { return Mix(belt, top, up); };
  return {{0.93f * side, bottom},
          {0.975f * side, door(0.08f)},
          {0.995f * side, door(0.3f)},
          {side, door(0.6f)},
          {0.988f * side, door(0.86f)},
          {0.975f * side, door(0.97f)},
          {shoulder, belt},
          {Mix(shoulder, roof, 0.5f) + 0.01f, glass(0.5f)},
          {roof, glass(0.93f)},
          {roof - 0.05f, glass(0.985f)},
          {0.55f * roof, top - 0.002f},
          {0, top}};
}

/// Positions of the sections: even, and closer at the ends and around the wheels, whose arches are
/// round.
std::vector<float> Stations(const CarShape& shape) {
  std::vector<float> stations;
  constexpr int kEven = 40, kArch = 14;
  for (int i = 0; i <= kEven; ++i) {
    stations.push_back(Mix(shape.nose(), shape.tail, static_cast<float>(i) / kEven));
  }
  for (float inset : {0.006f, 0.02f, 0.045f}) {
    stations.push_back(shape.nose() - inset);
    stations.push_back(shape.tail + inset);
  }
  for (float axle : {shape.front_axle, shape.rear_axle}) {
    for (int i = 0; i <= kArch; ++i) {
      const float x = axle + shape.arch_radius *
                                 std::cos(static_cast<float>(M_PI) * static_cast<float>(i) / kArch);
      if (x > shape.tail) stations.push_back(x);
    }
  }
  std::sort(stations.begin(), stations.end(), std::greater<>());
  const auto close = [](float a, float b) { return a - b < 1e-3f; };
  stations.erase(std::unique(stations.begin(), stations.end(), close), stations.end());
  return stations;
}

void AddBody(const CarShape& shape, Mesh& mesh) {
  std::vector<std::vector<int>> rings;  // from the left sill over the roof to the right sill
  for (float x : Stations(shape)) {
    const std::vector<Vec2f> half = Section(shape, x);
    std::vector<int>& ring = rings.emplace_back();
    for (const Vec2f& point : half) ring.push_back(mesh.AddPoint({x, point.x(), point.y()}));
    for (auto point = half.rbegin() + 1; point != half.rend(); ++point)
      ring.push_back(mesh.AddPoint({x, -point->x(), point->y()}));
  }
  const int last = static_cast<int>(rings[0].size()) - 1;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const std::vector<int>&front = rings[i - 1], &back = rings[i];
    for (int row = 0; row < last; ++row) {
      const bool top = row >= kTopRow && row < last - kTopRow;
      mesh.AddQuad(front[row], back[row], back[row + 1], front[row + 1], top ? kCarTop : kCarSide);
    }
    mesh.AddQuad(back[0], front[0], front[last], back[last], kCarUnder);
  }
  for (int row = 0; row < last / 2; ++row) {  // nose and tail: across from left to right
    const std::vector<int>&front = rings.front(), &back = rings.back();
    mesh.AddQuad(front[last - row], front[row], front[row + 1], front[last - row - 1], kCarFront);
    mesh.AddQuad(back[row], back[last - row], back[last - row - 1], back[row + 1], kCarRear);
  }
}

void AddWheels(const CarShape& shape, Mesh& mesh) {
  constexpr float kTyre = 0.2f;
  constexpr int kSides = 28;
  for (float axle : {shape.front_axle, shape.rear_axle}) {
    const float out = std::min(shape.HalfWidth(axle), shape.half_width) - 0.01f;
    for (float side : {-1.f, 1.f}) {
      const Vec3f inner(axle, side * (out - kTyre), shape.wheel_radius),
          outer(axle, side * out, shape.wheel_radius);
      const Vec3f shoulder = Mix(inner, outer, 0.88f);
      AddCone(mesh, {inner, shape.wheel_radius}, {shoulder, shape.wheel_radius}, kSides, kCarWheel);
      AddCone(mesh, {shoulder, shape.wheel_radius}, {outer, 0.92f * shape.wheel_radius}, kSides,
              kCarWheel);
    }
  }
}

void AddMirrors(const CarShape& shape, Mesh& mesh) {
  const float x = shape.screen_base - 0.32f, z = shape.belt + 0.02f;
  const float out = 0.5f * shape.width, in = shape.half_roof + 0.05f;
  AddBox(mesh, {x, in, z}, {x + 0.1f, out, z + 0.13f}, kCarMirror);
  AddBox(mesh, {x, -out, z}, {x + 0.1f, -in, z + 0.13f}, kCarMirror);
}

}  // namespace

Mesh MakeCarMesh(const CarShape& shape) {
  Mesh mesh;
  AddBody(shape, mesh);
  AddWheels(shape, mesh);
  AddMirrors(shape, mesh);
  if (shape.style == CarStyle::kTruck) {
    const float half = 0.5f * shape.width;
    AddBox(mesh, {-shape.nose(), -half, 0.85f}, {shape.tail - 0.06f, half, shape.height}, kCarBox);
    AddBox(mesh, {-shape.nose() + 0.1f, -0.4f, 0.45f}, {shape.tail, 0.4f, 0.85f}, kCarUnder);
  }
  ComputeNormals(mesh);
  return mesh;
}

}  // namespace sslcd::render
