// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.h"

#include <cmath>

#include "sim/check_fields.h"
#include "sim/furnish.h"
#include "sim/random.h"

namespace sslcd::sim {
namespace {

// The left colour camera of KITTI's drives of 2011-09-26.
World EmptyWorld() {
  World world;
  world.camera = {721.5377, 721.5377, 609.5593, 172.854, Vec3(0.06, 0, 0), 1242, 375};
  world.labels.Set("Car", {Symmetry::kNone});
  world.labels.Set("Pole", {Symmetry::kFull});
  return world;
}

void AddParkedCar(World& world, Random& random, const Path& path, double s_m, double right_m,
                  double turn_rad) {
  // How exactly drivers park along and across the street. Set by hand. [m], [rad]
  constexpr double kSigmaAlong = 0.2, kSigmaAcross = 0.1, kSigmaTurn = 0.03;
  const Vec3 dims = CarDims(random);
  const double s = s_m + random.Normal(0, kSigmaAlong);
  const double right = right_m + random.Normal(0, kSigmaAcross);
  const double turn = turn_rad + random.Normal(0, kSigmaTurn);
  Add(world, "Car", dims, {path.ObjectAt(s, right, CentreY(world, dims), turn)});
}

void AddPole(World& world, Random& random, const Path& path, double s_m, double right_m) {
  const Vec3 dims = PoleDims(random);
  Add(world, "Pole", dims, {path.ObjectAt(s_m, right_m, CentreY(world, dims), 0)});
}

}  // namespace

World MakeStreet(std::uint64_t seed, const StreetOptions& options) {
  CheckFields(options);
  Random random(seed);
  World world = EmptyWorld();

  // A street with kerb-side parking. All set by hand.
  constexpr double kAhead = 60;   // length of the street beyond the end of the drive [m]
  constexpr double kSpace = 5.8;  // one kerb-side parking space [m]
  constexpr double kMinPiece = 15, kMaxPiece = 40;        // of constant curvature [m]
  constexpr double kRightCars = 3.2, kLeftCars = -6.6;    // to the right of the path [m]
  constexpr double kRightPoles = 5.2, kLeftPoles = -8.6;  // the same
  constexpr double kOncomingLane = -3.4;                  // the same
  constexpr double kPoleScatter = 4;                      // along the street [m]
  constexpr double kTurnedRound = 0.1;                    // share of the parked cars
  const double driven = options.speed_mps * (options.frames - 1) / options.frame_rate_hz;
  std::vector<PathPiece> pieces;
  for (double length = 0; length < driven + kAhead; length += pieces.back().length_m) {
    pieces.push_back({random.Uniform(kMinPiece, kMaxPiece),
                      random.Uniform(-options.bend_rad_per_m, options.bend_rad_per_m)});
  }
  const Path path(pieces);
  Drive(path, options.frames, options.frame_rate_hz, options.speed_mps, world);

  for (double s = 4; s < driven + kAhead; s += kSpace) {
    const bool turned_round = random.Chance(kTurnedRound);
    if (!random.Chance(options.free_fraction))
      AddParkedCar(world, random, path, s, kRightCars, turned_round ? M_PI : 0);
    if (!random.Chance(options.free_fraction))
      AddParkedCar(world, random, path, s + 2, kLeftCars, turned_round ? 0 : M_PI);
  }
  for (double s = 8; s < driven + kAhead; s += options.pole_spacing_m) {
    AddPole(world, random, path, s + random.Uniform(-kPoleScatter, kPoleScatter), kRightPoles);
    AddPole(world, random, path,
            s + random.Uniform(-kPoleScatter, kPoleScatter) + 0.5 * options.pole_spacing_m,
            kLeftPoles);
  }
  for (int i = 0; i < options.driving_cars; ++i) {
    const double speed = options.speed_mps * random.Uniform(0.9, 1.3);
    const bool oncoming = i % 2 == 1;
    if (oncoming) {
      AddDrivingCar(world, random, path, random.Uniform(0.3, 2) * driven + 30, kOncomingLane,
                    -speed);
    } else {
      AddDrivingCar(world, random, path, 12 + 15 * i, 0, std::max(speed, options.speed_mps));
    }
  }
  return world;
}

World MakeParkingLot(std::uint64_t seed, const ParkingLotOptions& options) {
  CheckFields(options);
  Random random(seed);
  World world = EmptyWorld();

  // One lap: up an aisle, a right-hand turn in two quarter circles, down the other aisle, and back.
  // The camera starts in the middle of the first aisle.
  constexpr double kRadius = 6;  // of the quarter circles
  // straight part between two of them; aisles are 2 * kRadius + kAcross apart
  constexpr double kAcross = 6;
  // aisle's middle line to the middle of a stall
  constexpr double kStallWidth = 2.6, kToStall = 5.7;
  const double curve = 0.5 * M_PI * kRadius;
  const std::vector<PathPiece> half_lap = {
      {curve, 1 / kRadius}, {kAcross, 0}, {curve, 1 / kRadius}};
  std::vector<PathPiece> lap = {{0.5 * options.aisle_m, 0}};
  lap.insert(lap.end(), half_lap.begin(), half_lap.end());
  lap.push_back({options.aisle_m, 0});
  lap.insert(lap.end(), half_lap.begin(), half_lap.end());
  lap.push_back({0.5 * options.aisle_m, 0});
  const Path path(lap, true);
  Drive(path, options.frames, options.frame_rate_hz, options.speed_mps, world);

  // Cars park across the aisle, nose in or tail in. The layout of both aisles follows their
  // direction of travel.
  const double other_aisle = 0.5 * path.length() - 0.5 * options.aisle_m;
  for (double start : {-0.5 * options.aisle_m, other_aisle}) {
    for (double s = 0.5 * kStallWidth; s < options.aisle_m; s += kStallWidth) {
      for (double side : {kToStall, -kToStall}) {
        const double turn = random.Chance(0.7) ? 0.5 * M_PI : -0.5 * M_PI;
        if (!random.Chance(options.free_fraction))
          AddParkedCar(world, random, path, start + s, side, turn);
      }
    }
    for (double end : {-2., options.aisle_m + 2.})
      AddPole(world, random, path, start + end, -kToStall - 3);
  }
  for (int i = 0; i < options.driving_cars; ++i) {
    AddDrivingCar(world, random, path, 12 + 12 * i, 0, options.speed_mps);
  }
  return world;
}

void DescribeFields(FieldVisitor& visitor, StreetOptions& options) {
  visitor.Integer("frames", options.frames, 1, 1000000, "number of frames");
  visitor.Real("frame_rate_hz", options.frame_rate_hz, 0.1, 1000, "frames per second");
  visitor.Real("speed_mps", options.speed_mps, 0, 100, "speed of the camera");
  visitor.Real("bend_rad_per_m", options.bend_rad_per_m, 0, 0.05, "largest curvature of the road");
  visitor.Real("free_fraction", options.free_fraction, 0, 1,
               "fraction of the parking spaces that are free");
  visitor.Real("pole_spacing_m", options.pole_spacing_m, 1, 1e6,
               "distance between two poles of one side");
  visitor.Integer("driving_cars", options.driving_cars, 0, 100,
                  "cars that drive; every second one is oncoming");
}

void DescribeFields(FieldVisitor& visitor, ParkingLotOptions& options) {
  visitor.Integer("frames", options.frames, 1, 1000000, "number of frames");
  visitor.Real("frame_rate_hz", options.frame_rate_hz, 0.1, 1000, "frames per second");
  visitor.Real("speed_mps", options.speed_mps, 0, 100, "speed of the camera");
  visitor.Real("aisle_m", options.aisle_m, 5, 1000, "length of the rows of stalls");
  visitor.Real("free_fraction", options.free_fraction, 0, 1,
               "fraction of the stalls that are free");
  visitor.Integer("driving_cars", options.driving_cars, 0, 10,
                  "cars that drive ahead of the camera");
}

}  // namespace sslcd::sim
