// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/path.h"
#include "sim/random.h"
#include "sim/world.h"

namespace sslcd::sim {

/// Adds frames along the path at constant speed from its start.
void Drive(const Path& path, int frames, double rate_hz, double speed_mps, World& world);

/// Adds an object with the next free id.
WorldObject& Add(World& world, const std::string& label, const Vec3& dims, std::vector<Pose> poses);

/// Draws length, width and height of a passenger car. [m]
Vec3 CarDims(Random& random);

/// y of the centre of an object on the ground.
double CentreY(const World& world, const Vec3& dims);

/// Draws diameter (twice) and height of a pole. [m]
Vec3 PoleDims(Random& random);

/// Adds a car that follows the path from `s_m` at `speed_mps` (negative: oncoming).
WorldObject& AddDrivingCar(World& world, Random& random, const Path& path, double s_m,
                           double right_m, double speed_mps);

}  // namespace sslcd::sim
