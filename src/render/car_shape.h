// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/mesh.h"
#include "sim/world.h"

namespace sslcd::render {

enum class CarStyle { kSaloon, kHatchback, kEstate, kVan, kTruck };

/// A procedural vehicle, which depends on the seed and fills the object's dimensions. Its frame: x
/// forward, y left, z up from the ground below the middle. All lengths in metres.
struct CarShape {
  CarStyle style = CarStyle::kHatchback;
  float length = 0, width = 0, height = 0;
  std::uint32_t seed = 0;

  std::vector<Vec2f> outline;  ///< of the side view from nose to tail: x, z
  float tail = 0;              ///< x of its end; the rear of a truck is a box
  float belt = 0;              ///< height of the windows' lower edge
  float clearance = 0, wheel_radius = 0, arch_radius = 0;
  float front_axle = 0, rear_axle = 0;                                         ///< x
  float screen_base = 0, roof_front = 0, roof_rear = 0, rear_window_base = 0;  ///< x
  /// half widths of the body and of its roof
  float half_width = 0, half_roof = 0;

  float nose() const { return 0.5f * length; }
  float Top(float x) const;        ///< height of the outline, its corners rounded
  float Bottom(float x) const;     ///< height of the underside, which rises over the wheels
  float HalfWidth(float x) const;  ///< half width of the body, which narrows towards nose and tail
  float HalfTop(float x) const;    ///< half width of bonnet, roof or boot
};

bool IsVehicle(const sim::WorldObject& object);
CarShape MakeCarShape(const sim::WorldObject& object, std::uint32_t seed);

/// The part of a car that a triangle belongs to.
enum CarPart { kCarSide, kCarTop, kCarFront, kCarRear, kCarUnder, kCarWheel, kCarMirror, kCarBox };
Mesh MakeCarMesh(const CarShape& shape);

}  // namespace sslcd::render
