// SPDX-License-Identifier: BSD-3-Clause
#include "sim/furnish.h"

#include <cmath>

namespace sslcd::sim {

void Drive(const Path& path, int frames, double rate_hz, double speed_mps, World& world) {
  for (int i = 0; i < frames; ++i) {
    world.truth.stamps.push_back(i / rate_hz);
    world.truth.poses.push_back(path.CameraAt(speed_mps * i / rate_hz));
  }
}

WorldObject& Add(World& world, const std::string& label, const Vec3& dims,
                 std::vector<Pose> poses) {
  WorldObject& object = world.objects.emplace_back();
  object.id = static_cast<int>(world.objects.size()) - 1;
  object.label = label;
  object.dims = dims;
  object.T_world_object = std::move(poses);
  return object;
}

// Sizes of cars and poles [m]: set by hand.
Vec3 CarDims(Random& random) {
  return {random.Uniform(3.5, 4.7), random.Uniform(1.55, 1.85), random.Uniform(1.4, 1.75)};
}

Vec3 PoleDims(Random& random) {
  const double diameter = random.Uniform(0.15, 0.35);
  return {diameter, diameter, random.Uniform(2.5, 4.)};
}

double CentreY(const World& world, const Vec3& dims) {
  return world.camera_height_m - 0.5 * dims.z();
}

WorldObject& AddDrivingCar(World& world, Random& random, const Path& path, double s_m,
                           double right_m, double speed_mps) {
  const Vec3 dims = CarDims(random);
  std::vector<Pose> poses;
  for (double stamp : world.truth.stamps) {
    poses.push_back(path.ObjectAt(s_m + speed_mps * stamp, right_m, CentreY(world, dims),
                                  speed_mps < 0 ? M_PI : 0));
  }
  return Add(world, "Car", dims, std::move(poses));
}

}  // namespace sslcd::sim
