// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sslcd/core/error.h"

namespace sslcd::sim {
namespace {

void ExpectSame(const Pose& a, const Pose& b) {
  for (int i = 0; i < Pose::kParameters; ++i) EXPECT_EQ(a.data()[i], b.data()[i]);
}

void ExpectSame(const World& a, const World& b) {
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i)
    ExpectSame(a.objects[i].PoseAt(0), b.objects[i].PoseAt(0));
}

void ExpectSane(const World& world, int frames) {
  ASSERT_EQ(world.truth.size(), static_cast<std::size_t>(frames));
  ASSERT_EQ(world.truth.stamps.size(), world.truth.size());
  EXPECT_NEAR(world.truth.poses[0].Log().norm(), 0, 1e-12);
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const WorldObject& object = world.objects[i];
    EXPECT_EQ(object.id, static_cast<int>(i));
    EXPECT_TRUE((object.dims.array() > 0).all());
    EXPECT_EQ(object.T_world_object.size(), object.driving() ? frames : 1u);
    EXPECT_TRUE(world.labels.entries().count(object.label)) << object.label;
    for (const Pose& pose : object.T_world_object) {
      const Vec3 up = pose.so3() * Vec3(Vec3::UnitZ());
      EXPECT_NEAR((up - world.gravity.up).norm(), 0, 1e-9);                     // upright
      EXPECT_NEAR(pose.translation().y() + 0.5 * object.dims.z(), 1.65, 1e-9);  // on the ground
    }
  }
}

int Count(const World& world, const std::string& label, bool driving) {
  return static_cast<int>(
      std::count_if(world.objects.begin(), world.objects.end(), [&](const WorldObject& object) {
        return object.label == label && object.driving() == driving;
      }));
}

/// Parked objects do not overlap, tested by circles within the widths of the cuboids.
void ExpectNoOverlap(const World& world) {
  for (const WorldObject& a : world.objects) {
    for (const WorldObject& b : world.objects) {
      if (a.id >= b.id || a.driving() || b.driving()) continue;
      const double distance = (a.PoseAt(0).translation() - b.PoseAt(0).translation()).norm();
      EXPECT_GT(distance, 0.5 * (a.dims.y() + b.dims.y())) << a.id << " and " << b.id;
    }
  }
}

TEST(MakeStreet, IsSane) {
  for (int seed = 0; seed < 5; ++seed) {
    const World world = MakeStreet(seed);
    ExpectSane(world, 300);
    ExpectNoOverlap(world);
    EXPECT_GT(Count(world, "Car", false), 40);
    EXPECT_GT(Count(world, "Pole", false), 10);
    EXPECT_EQ(Count(world, "Car", true), 4);
  }
}

TEST(MakeStreet, LeavesTheLaneFree) {
  const World world = MakeStreet(3);
  for (const WorldObject& object : world.objects) {
    if (object.driving()) continue;
    for (const Pose& T_world_cam : world.truth.poses) {
      const double distance =
          (T_world_cam.translation() - object.PoseAt(0).translation()).head<3>().norm();
      EXPECT_GT(distance, 1.5);
    }
  }
}

TEST(MakeStreet, CameraDrivesForwardAtItsSpeed) {
  const World world = MakeStreet(2);
  for (std::size_t i = 1; i < world.truth.size(); ++i) {
    const Vec3 step = (world.truth.poses[i - 1].inverse() * world.truth.poses[i]).translation();
    EXPECT_NEAR(step.z(), 0.8, 1e-3);  // 8 m/s at 10 Hz
    EXPECT_LT(std::abs(step.x()), 0.01);
    EXPECT_EQ(step.y(), 0);
  }
}

TEST(MakeStreet, DrivingCarsMoveAlongTheirLength) {
  for (const WorldObject& object : MakeStreet(4).objects) {
    if (!object.driving()) continue;
    for (std::size_t i = 1; i < object.T_world_object.size(); ++i) {
      const Vec3 step = (object.PoseAt(int(i) - 1).inverse() * object.PoseAt(int(i))).translation();
      EXPECT_GT(step.x(), 0.5);
      EXPECT_LT(std::abs(step.y()), 0.1);
    }
  }
}

TEST(MakeParkingLot, IsSaneAndComesBack) {
  ParkingLotOptions options;
  options.frames = 400;
  const World world = MakeParkingLot(1, options);
  ExpectSane(world, 400);
  ExpectNoOverlap(world);
  EXPECT_GT(Count(world, "Car", false), 30);
  EXPECT_EQ(Count(world, "Car", true), 1);
  double nearest = 1e9;
  for (std::size_t i = 200; i < world.truth.size(); ++i) {
    nearest = std::min(nearest, world.truth.poses[i].Log().norm());  // place and direction
  }
  EXPECT_LT(nearest, 0.5);
}

TEST(MakeParkingLot, CarsStandAcrossTheAisle) {
  const World world = MakeParkingLot(2);
  for (const WorldObject& object : world.objects) {
    if (object.label != "Car" || object.driving()) continue;
    const Vec3 heading = object.PoseAt(0).so3() * Vec3(Vec3::UnitX());
    EXPECT_GT(std::abs(heading.x()), 0.95);  // the aisles run along z
  }
}

TEST(Worlds, AreTheSameForTheSameSeed) {
  ExpectSame(MakeStreet(5), MakeStreet(5));
  ExpectSame(MakeParkingLot(5), MakeParkingLot(5));
  EXPECT_NE(MakeStreet(5).objects.size(), MakeStreet(6).objects.size());
}

TEST(Worlds, ExtremeOptions) {
  StreetOptions street;
  street.frames = 1;
  street.free_fraction = 1;
  street.driving_cars = 0;
  EXPECT_EQ(Count(MakeStreet(1, street), "Car", false), 0);
  street.speed_mps = 0;
  street.frames = 10;
  EXPECT_NEAR(MakeStreet(1, street).truth.poses[9].Log().norm(), 0, 1e-12);
  ParkingLotOptions lot;
  lot.free_fraction = 0;
  EXPECT_EQ(Count(MakeParkingLot(1, lot), "Car", false), 2 * 2 * 23);  // every stall of two aisles
}

TEST(Worlds, BadOptionsAreNamedAllAtOnce) {
  StreetOptions street;
  street.frames = 0;
  street.frame_rate_hz = std::nan("");
  try {
    MakeStreet(1, street);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("frames is 0"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("frame_rate_hz"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sslcd::sim
