// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"

namespace sslcd::sim {

/// A parked or driving object of a synthetic world. Its frame is that of a Detection: centre, x
/// along the length, z up.
struct WorldObject {
  int id = 0;  ///< index in World::objects
  std::string label;
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]
  /// one pose if it is parked, one per frame if it drives
  std::vector<Pose> T_world_object;
  /// colour of its body: red, green, blue in [0, 1]
  Vec3 paint{0.5, 0.5, 0.5};
  int first_frame = 0;                              ///< first frame of its existence
  int end_frame = std::numeric_limits<int>::max();  ///< frame after its last one
  bool driving() const { return T_world_object.size() > 1; }
  bool IsThereAt(int frame) const { return first_frame <= frame && frame < end_frame; }
  const Pose& PoseAt(int frame) const { return T_world_object[driving() ? frame : 0]; }
};

/// A flat synthetic world and the camera's true path through it. World axes are those of the first
/// camera, KITTI style (x right, y down, z forward), so the first pose is the identity and up is
/// -y.
struct World {
  std::vector<WorldObject> objects;
  Trajectory truth;  ///< T_world_cam for every frame
  GravityFrame gravity;
  Camera camera;
  double camera_height_m = 1.65;  ///< above the ground; default: the KITTI car's
  double baseline_m = 0.54;       ///< to the right camera
  LabelTable labels;
};

/// A winding street: cars parked along both kerbs with gaps, poles on the pavement, cars driving in
/// both lanes.
struct StreetOptions {
  int frames = 300;
  double frame_rate_hz = 10.;
  double speed_mps = 8.;
  double bend_rad_per_m = 0.012;  ///< largest curvature of the road
  double free_fraction = 0.3;     ///< share of free parking spaces
  double pole_spacing_m = 30.;
  int driving_cars = 4;  ///< number of driving cars; half of them oncoming
};
World MakeStreet(std::uint64_t seed, const StreetOptions& options = {});

/// A regular parking lot: the camera drives laps around a double row of stalls, with a row on the
/// outer side of each aisle. One lap is about 170 m with the default length.
struct ParkingLotOptions {
  int frames = 300;
  double frame_rate_hz = 10.;
  double speed_mps = 6.;
  double aisle_m = 60.;        ///< length of the rows
  double free_fraction = 0.4;  ///< share of free stalls
  int driving_cars = 1;        ///< number of cars driving ahead on the same lap
};
World MakeParkingLot(std::uint64_t seed, const ParkingLotOptions& options = {});

/// The generators throw Error(kUsage) for values outside of these ranges.
void DescribeFields(FieldVisitor& visitor, StreetOptions& options);
void DescribeFields(FieldVisitor& visitor, ParkingLotOptions& options);

}  // namespace sslcd::sim
