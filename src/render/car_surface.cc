// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
#include <optional>

#include "render/noise.h"
#include "render/surface.h"

namespace sslcd::render {
namespace {

enum Kind { kPaint, kGlass, kPlastic, kLamp, kPlate, kTyre, kRim, kSeam };

const Surface kGlassSurface{Vec3f(0.012f, 0.014f, 0.016f), 0.09f, 900, kGlass};
const Surface kPlasticSurface{Vec3f(0.028f, 0.028f, 0.03f), 0.02f, 12, kPlastic};
const Surface kChrome{Vec3f(0.35f, 0.35f, 0.37f), 0.3f, 200, kLamp};

bool Within(float value, float low, float high) { return low < value && value < high; }

/// A number plate: white with dark strokes, seven characters of 3 x 5 blocks.
Surface Plate(const CarShape& shape, float u, float v) {
  const Surface white{Vec3f(0.75f, 0.76f, 0.74f), 0.03f, 30, kPlate};
  const Surface black{Vec3f(0.03f, 0.03f, 0.05f), 0.03f, 30, kSeam};
  if (u < 0.07f) return {Vec3f(0.02f, 0.07f, 0.4f), 0.03f, 30, kSeam};
  const float place = (u - 0.1f) / 0.87f * 7, column = Fraction(place) * 4,
              row = (v - 0.15f) / 0.7f * 5;
  if (!Within(place, 0, 7) || !Within(row, 0, 5) || column > 3) return white;
  const int block = static_cast<int>(column) + 3 * static_cast<int>(row);
  const std::uint32_t sign = Hash(shape.seed + 77, static_cast<std::uint32_t>(place));
  return (sign >> block & 1) || block % 3 == 0 ? black : white;
}

Surface Wheel(const CarShape& shape, const SurfacePoint& point) {
  const Surface tyre{Vec3f(0.022f, 0.022f, 0.024f), 0.01f, 8, kTyre};
  const float axle = point.position.x() > 0.5f * (shape.front_axle + shape.rear_axle)
                         ? shape.front_axle
                         : shape.rear_axle;
  const float x = point.position.x() - axle, z = point.position.z() - shape.wheel_radius;
  const float radius = std::hypot(x, z) / shape.wheel_radius;
  if (std::abs(point.normal.y()) < 0.8f || radius > 0.7f) return tyre;
  const Surface rim{Vec3f::Constant(Mix(0.2f, 0.5f, Unit(Hash(shape.seed, 31)))), 0.12f, 60, kRim};
  const Surface gap{Vec3f::Constant(0.01f), 0, 1, kSeam};
  if (radius > 0.62f || radius < 0.16f) return rim;
  const float spokes = static_cast<float>(5 + Hash(shape.seed, 32) % 4);
  const float turn = Unit(Hash(shape.seed, axle > 0 ? 33 : 34));
  const float wave = std::atan2(z, x) / (2 * static_cast<float>(M_PI)) * spokes + turn * spokes;
  const float off = std::abs(Fraction(wave) - 0.5f) / spokes * radius * 6.28f;
  return off < 0.07f ? rim : gap;
}

/// Nose: lamps, grille, number plate, air intake.
std::optional<Surface> Front(const CarShape& shape, const SurfacePoint& point) {
  const float y = std::abs(point.position.y()) / shape.half_width, z = point.position.z();
  const float edge = shape.outline[1].y(), lamp_in = Mix(0.48f, 0.62f, Unit(Hash(shape.seed, 41)));
  const float slant = 0.05f * (y - lamp_in);
  if (Within(z, edge - 0.1f + slant, edge + 0.035f + slant) && y > lamp_in) {
    const float core =
        std::hypot((y - 0.5f * (lamp_in + 0.9f)) * shape.half_width, z - edge + 0.03f);
    if (core < 0.055f) return Surface{Vec3f(0.75f, 0.77f, 0.8f), 0.25f, 100, kLamp};
    return Surface{Vec3f(0.22f, 0.23f, 0.25f), 0.15f, 200, kGlass};
  }
  const float plate_z = Mix(shape.clearance + 0.1f, edge - 0.1f, 0.55f);
  if (std::abs(point.position.y()) < 0.26f && std::abs(z - plate_z) < 0.055f)
    return Plate(shape, 0.5f + point.position.y() / 0.52f, 0.5f + (plate_z - z) / 0.11f);
  if (Within(z, edge - 0.1f, edge - 0.005f) && y < lamp_in - 0.08f) {
    if (std::hypot(point.position.y(), z - edge + 0.05f) < 0.04f) return kChrome;
    const float bars = z / 0.022f;
    const bool bar = Hash(shape.seed, 42) % 2 && Fraction(bars) < 0.3f && point.footprint < 0.02f;
    return bar ? kChrome : kPlasticSurface;
  }
  if (Within(z, shape.clearance, plate_z - 0.07f) && y < 0.72f) return kPlasticSurface;
  return std::nullopt;
}

/// Tail: lamps, number plate, bumper.
std::optional<Surface> Rear(const CarShape& shape, const SurfacePoint& point) {
  const float y = std::abs(point.position.y()) / shape.half_width, z = point.position.z();
  const bool tall = shape.style != CarStyle::kSaloon;
  const float low = shape.belt - (tall ? Mix(0.2f, 0.34f, Unit(Hash(shape.seed, 51))) : 0.17f);
  const float in = tall ? Mix(0.58f, 0.68f, Unit(Hash(shape.seed, 52))) : 0.52f;
  if (y > in && Within(z, low, shape.belt - 0.01f)) {
    const bool white = Within(z, low + 0.04f, low + 0.08f);
    return white ? Surface{Vec3f(0.5f, 0.45f, 0.4f), 0.06f, 80, kLamp}
                 : Surface{Vec3f(0.32f, 0.012f, 0.012f), 0.07f, 80, kLamp};
  }
  const float plate_z = Mix(shape.clearance, shape.belt, 0.58f);
  if (std::abs(point.position.y()) < 0.26f && std::abs(z - plate_z) < 0.055f)
    return Plate(shape, 0.5f - point.position.y() / 0.52f, 0.5f + (plate_z - z) / 0.11f);
  if (z < shape.clearance + 0.17f) return kPlasticSurface;
  const float seam = Mix(shape.clearance, shape.belt, 0.42f);
  if (std::abs(z - seam) < 0.006f) return Surface{Vec3f::Constant(0.01f), 0, 1, kSeam};
  const bool window = shape.style == CarStyle::kVan &&
                      Within(z, shape.belt + 0.08f, 0.9f * shape.height) &&
                      Within(y, 0.06f, 0.72f) && Hash(shape.seed, 53) % 2;
  if (window) return kGlassSurface;
  return std::nullopt;
}

bool IsGlass(const CarShape& shape, const SurfacePoint& point, float pillar) {
  const float x = point.position.x(), z = point.position.z(), top = shape.Top(x);
  if (point.part == kCarTop) {
    const bool wide = std::abs(point.position.y()) < shape.HalfTop(x) - 0.035f;
    const bool screen = Within(x, shape.roof_front - 0.02f, shape.screen_base - 0.02f) &&
                        z < 0.985f * shape.Top(shape.roof_front);
    const bool rear = shape.style != CarStyle::kVan && shape.style != CarStyle::kTruck &&
                      Within(x, shape.rear_window_base, shape.roof_rear) &&
                      z < 0.97f * shape.Top(shape.roof_rear) &&
                      z > shape.Top(shape.rear_window_base) + 0.03f;
    return wide && (screen || rear);
  }
  if (z < shape.belt + 0.03f || top - z < 0.075f) return false;
  if (x > shape.screen_base - 0.2f) return false;
  if (shape.style == CarStyle::kTruck) return x > shape.tail + 0.15f;
  const bool blind = shape.style == CarStyle::kVan && Hash(shape.seed, 61) % 2;  // a delivery van
  if (blind) return x > pillar;
  return x > -shape.nose() + (shape.style == CarStyle::kSaloon ? 0.2f * shape.length : 0.16f);
}

/// The interior behind the glass: seats before a brighter background, the dashboard below the
/// windscreen.
Surface Glass(const CarShape& shape, const SurfacePoint& point, float pillar) {
  Surface glass{Vec3f(0.012f, 0.014f, 0.015f), 0.09f, 900, kGlass};
  const float seat_z = shape.belt + 0.2f;
  float off = 0;  // across the nearest headrest
  if (point.part == kCarSide) {
    off = std::min(std::abs(point.position.x() - pillar - 0.1f),
                   std::abs(point.position.x() - pillar + 0.85f));
    glass.albedo *=
        0.6f + 2.6f * Clamp01((point.position.z() - shape.belt) / (shape.height - shape.belt));
  } else {
    off = std::abs(std::abs(point.position.y()) - 0.37f);
    if (point.position.x() > shape.screen_base - 0.22f) glass.albedo = Vec3f::Constant(0.03f);
  }
  const float rest = std::max(off / 0.13f, (point.position.z() - seat_z) / 0.1f);
  if (rest < 1) glass.albedo = Vec3f::Constant(0.005f);
  return glass;
}

/// A truck's box: panels with ribs; behind, doors above lamps and a number plate.
Surface CargoBox(const CarShape& shape, const Surface& body, const SurfacePoint& point,
                 float dirt) {
  const float z = point.position.z();
  const Vec3f panel = Hash(shape.seed, 72) % 2 ? Vec3f(0.62f, 0.62f, 0.6f) : body.albedo;
  const float rib = point.position.x() / 0.6f,
              lamp = std::abs(point.position.y()) / shape.half_width;
  if (point.normal.x() < -0.5f && z < 1.02f) {
    if (std::abs(point.position.y()) < 0.26f && std::abs(z - 0.94f) < 0.055f)
      return Plate(shape, 0.5f - point.position.y() / 0.52f, 0.5f + (0.94f - z) / 0.11f);
    return lamp > 0.75f ? Surface{Vec3f(0.3f, 0.012f, 0.012f), 0.07f, 80, kLamp} : kPlasticSurface;
  }
  const float stripe = Band((Fraction(rib) - 0.5f) * 0.6f, 0.008f, point.footprint);
  const bool door = point.normal.x() < -0.5f && std::abs(point.position.y()) < 0.01f;
  return {panel * (1 + 0.04f * dirt) * (door ? 0.2f : 1 - 0.5f * stripe), 0.02f, 30, kPaint};
}

/// The seams around the doors of a side, and their handles.
void DrawDoors(const CarShape& shape, const SurfacePoint& point, float pillar, Surface& body) {
  const float x = point.position.x(), first = shape.screen_base - 0.3f;
  if (point.position.z() >= shape.belt || x >= first + 0.1f || x <= shape.rear_axle - 0.1f) return;
  const float last = std::max(shape.rear_axle + 0.62f * shape.arch_radius, pillar - 1.05f);
  float seam = 0;
  for (float at : {first, pillar, last})
    seam = std::max(seam, Band(x - at, 0.007f, point.footprint));
  body.albedo *= 1 - 0.9f * seam;
  body.reflectivity *= 1 - seam;
  for (float at : {pillar, last}) {
    if (Within(x - at, 0.05f, 0.22f) && Within(point.position.z() - shape.belt, -0.12f, -0.085f)) {
      body.albedo *= 0.45f;
      body.kind = kSeam;
    }
  }
}

}  // namespace

Surface CarSurface(const CarShape& shape, const Vec3f& paint, const SurfacePoint& point) {
  const float x = point.position.x(), z = point.position.z();
  const float dirt = Fractal(x + point.position.y(), z, shape.seed, {3, 3}, point.footprint);
  const float low = 1 - Smooth(0.2f, 0.7f, z);
  Surface body{Linear(paint) * (1 + 0.05f * dirt), 0.045f, 250, kPaint};
  body.albedo = Mix(body.albedo, Vec3f(0.09f, 0.08f, 0.07f), low * (0.12f + 0.1f * dirt));
  body.sky_visibility = Mix(1, 0.55f, low);

  if (point.part == kCarWheel) return Wheel(shape, point);
  if (point.part == kCarUnder) return {Vec3f::Constant(0.015f), 0, 1, kPlastic, 0.2f};
  if (point.part == kCarMirror) return Hash(shape.seed, 71) % 3 ? body : kPlasticSurface;
  if (point.part == kCarBox) return CargoBox(shape, body, point, dirt);

  if (point.normal.x() > 0.4f && x > shape.nose() - 0.35f) {
    if (const auto front = Front(shape, point)) return *front;
  }
  if (point.normal.x() < -0.4f && x < -shape.nose() + 0.3f) {
    if (const auto rear = Rear(shape, point)) return *rear;
  }
  const float pillar = Mix(shape.front_axle, shape.rear_axle, 0.47f);
  if (IsGlass(shape, point, pillar)) {
    const bool frame = point.part == kCarSide && std::abs(x - pillar) < 0.045f;
    return frame ? kPlasticSurface : Glass(shape, point, pillar);
  }
  if (point.part != kCarSide) return body;

  const float to_arch = std::min(std::hypot(x - shape.front_axle, z - shape.wheel_radius),
                                 std::hypot(x - shape.rear_axle, z - shape.wheel_radius)) -
                        shape.arch_radius;
  const bool rough = shape.style == CarStyle::kEstate && Hash(shape.seed, 73) % 2;
  if (z < shape.clearance + (rough ? 0.13f : 0.06f) || (rough && to_arch < 0.06f))
    return kPlasticSurface;
  DrawDoors(shape, point, pillar, body);
  return body;
}

}  // namespace sslcd::render
