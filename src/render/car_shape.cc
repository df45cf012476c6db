// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
#include "render/car_shape.h"

#include "render/noise.h"

namespace sslcd::render {
namespace {

/// Fractions of the length from the nose, and of the height.
struct Style {
  float bonnet_edge, bonnet;  ///< heights
  float screen_base, screen_base_height, roof_front, roof_rear, rear_window_base, rear_height,
      tail_height;
  float belt, front_axle, rear_axle;
};

const Style& StyleOf(CarStyle style) {
  static const Style kStyles[] = {
      {0.44f, 0.56f, 0.27f, 0.65f, 0.43f, 0.70f, 0.86f, 0.70f, 0.58f, 0.635f, 0.185f,
       0.81f},  // saloon
      {0.46f, 0.58f, 0.24f, 0.66f, 0.41f, 0.84f, 0.975f, 0.64f, 0.44f, 0.62f, 0.19f,
       0.83f},  // hatchback
      {0.47f, 0.59f, 0.26f, 0.66f, 0.42f, 0.90f, 0.985f, 0.64f, 0.46f, 0.62f, 0.19f,
       0.80f},  // estate, off-roader
      {0.38f, 0.48f, 0.13f, 0.54f, 0.27f, 0.95f, 0.995f, 0.58f, 0.40f, 0.54f, 0.16f, 0.80f},  // van
      {0.32f, 0.40f, 0.08f, 0.47f, 0.17f, 0.31f, 0.33f, 0.60f, 0.50f, 0.44f, 0.15f,
       0.76f},  // truck: the cab
  };
  return kStyles[static_cast<int>(style)];
}

CarStyle StyleFor(const sim::WorldObject& object, std::uint32_t seed) {
  if (object.label == "Van") return CarStyle::kVan;
  if (object.label == "Truck") return CarStyle::kTruck;
  const float draw = Unit(Hash(seed, 1));
  if (object.dims.x() > 4.2 && object.dims.z() < 1.6)
    return draw < 0.7f ? CarStyle::kSaloon : CarStyle::kEstate;
  if (object.dims.x() > 4.2) return draw < 0.8f ? CarStyle::kEstate : CarStyle::kHatchback;
  return draw < 0.8f ? CarStyle::kHatchback : CarStyle::kEstate;
}

}  // namespace

bool IsVehicle(const sim::WorldObject& object) {
  return object.label == "Car" || object.label == "Van" || object.label == "Truck";
}

CarShape MakeCarShape(const sim::WorldObject& object, std::uint32_t seed) {
  CarShape shape;
  shape.seed = seed;
  shape.style = StyleFor(object, seed);
  shape.length = static_cast<float>(object.dims.x());
  shape.width = static_cast<float>(object.dims.y());
  shape.height = static_cast<float>(object.dims.z());
  const Style& style = StyleOf(shape.style);
  const bool truck = shape.style == CarStyle::kTruck;
  const float cab = truck ? 0.86f * shape.height : shape.height;
  int draws = 10;
  const auto vary = [&](float value, float spread) {
    return value + spread * (2 * Unit(Hash(seed, ++draws)) - 1);
  };
  const auto x = [&](float fraction) { return (0.5f - fraction) * shape.length; };

  const bool van = truck || shape.style == CarStyle::kVan;
  const float spread = van ? 0.012f : 0.03f;
  const float bonnet = vary(style.bonnet, 0.5f * spread);
  const float screen = vary(style.screen_base, spread), roof_front = vary(style.roof_front, spread);
  const float roof_rear = vary(style.roof_rear, van ? 0 : spread);
  const float rear_base = vary(style.rear_window_base, van ? 0 : 0.012f);
  const float end = truck ? 0.335f : 1;
  const float corners[][2] = {{0, style.bonnet_edge - 0.1f},
                              {0.008f, style.bonnet_edge},
                              {0.05f, bonnet},
                              {screen, style.screen_base_height},
                              {roof_front, 0.965f},
                              {0.5f * (roof_front + roof_rear), 1},
                              {roof_rear, vary(0.955f, 0.02f)},
                              {rear_base, style.rear_height},
                              {end - 0.004f, style.tail_height + 0.08f},
                              {end, style.tail_height}};
  for (const auto& [along, up] : corners) shape.outline.emplace_back(x(along), up * cab);
  shape.tail = x(end);
  shape.screen_base = x(screen);
  shape.roof_front = x(roof_front);
  shape.roof_rear = x(roof_rear);
  shape.rear_window_base = x(rear_base);
  shape.belt = vary(style.belt, 0.015f) * cab;
  shape.clearance = vary(truck ? 0.3f : 0.19f, 0.03f);
  shape.wheel_radius = van ? vary(0.34f, 0.02f) : vary(0.205f, 0.012f) * shape.height;
  shape.arch_radius = shape.wheel_radius + 0.055f;
  shape.front_axle =
      std::min(x(vary(style.front_axle, 0.01f)), shape.nose() - shape.arch_radius - 0.12f);
  shape.rear_axle =
      std::max(x(vary(style.rear_axle, 0.01f)), -shape.nose() + shape.arch_radius + 0.12f);
  shape.half_width = 0.5f * shape.width - 0.01f;
  shape.half_roof = shape.half_width * (van ? vary(0.88f, 0.02f) : vary(0.74f, 0.03f));
  return shape;
}

float CarShape::Top(float x) const {
  const auto corner_line = [&](float at) {
    for (std::size_t i = 1; i < outline.size(); ++i) {
      if (at >= outline[i].x())
        return Mix(
            outline[i].y(), outline[i - 1].y(),
            Clamp01((at - outline[i].x()) / std::max(outline[i - 1].x() - outline[i].x(), 1e-4f)));
    }
    return outline.back().y();
  };
  const float ends = std::min(nose() - x, x - tail);
  const float reach = std::min(0.03f * length, std::max(ends, 0.f));
  float sum = 0;
  for (int i = -2; i <= 2; ++i) sum += corner_line(x + 0.5f * reach * static_cast<float>(i));
  return sum / 5;
}

float CarShape::Bottom(float x) const {
  const float overhang = std::min(nose() - x, x + nose());
  float bottom = clearance + 0.1f * (1 - Smooth(0, 0.5f, overhang));
  for (float axle : {front_axle, rear_axle}) {
    const float off = x - axle;
    if (std::abs(off) < arch_radius)
      bottom = std::max(bottom, wheel_radius + std::sqrt(arch_radius * arch_radius - off * off));
  }
  return bottom;
}

float CarShape::HalfWidth(float x) const {
  const float from_nose = std::max(1 - (nose() - x) / (0.16f * length), 0.f);
  const float from_tail =
      style == CarStyle::kTruck ? 0 : std::max(1 - (x + nose()) / (0.12f * length), 0.f);
  return half_width * (1 - 0.17f * from_nose * from_nose * from_nose -
                       0.12f * from_tail * from_tail * from_tail);
}

float CarShape::HalfTop(float x) const {
  const float up = Clamp01((Top(x) - belt) / (height - belt));
  return std::min(Mix(0.88f * half_width, half_roof, up), 0.93f * HalfWidth(x));
}

}  // namespace sslcd::render
