// SPDX-License-Identifier: BSD-3-Clause
#include "map_export/geojson.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sslcd {
namespace {

// A KITTI camera that looks north or east, and an object ahead of it and to its right.
TEST(MapGeoJson, PointsLieWhereTheCameraSeesThem) {
  MapInfo info;
  info.up_axis = Vec3(0, -1, 0);
  info.sessions.emplace_back();
  info.sessions[0].id = 1;
  info.sessions[0].name = "one";
  MapResults results;
  results.paths.emplace_back();
  results.paths[0].session = 1;
  const Pose start(lie::SO3<double>::RotY(0.7), Vec3(100, 5, 200));
  results.paths[0].trajectory.poses = {start, start * Pose::Trans(0, 0, 100)};
  MapObject object;
  object.state = LandmarkState::kConfirmed;
  object.T_world_object = start * Pose::Trans(50, 1, 1000);
  results.objects = {object, MapObject()};
  constexpr double kMetresOfDegree = 111.13e3;  // at 45 degrees of latitude, along the meridian
  const double across = kMetresOfDegree * 78.85 / 111.13;
  for (const double heading : {0., 90.}) {
    const auto json =
        nlohmann::json::parse(MapGeoJson(info, results, {45, 10, std::nullopt, heading}));
    ASSERT_EQ(json["features"].size(), 2u) << "confirmed landmarks alone";
    const auto& line = json["features"][0]["geometry"]["coordinates"];
    EXPECT_EQ(line[0], nlohmann::json({10., 45.}));
    EXPECT_EQ(json["features"][0]["properties"]["session"], "one");
    const auto& point = json["features"][1]["geometry"]["coordinates"];
    const double east = (point[0].get<double>() - 10) * across;
    const double north = (point[1].get<double>() - 45) * kMetresOfDegree;
    EXPECT_NEAR(east, heading == 0 ? 50 : 1000, 1);
    EXPECT_NEAR(north, heading == 0 ? 1000 : -50, 1);
  }
}

}  // namespace
}  // namespace sslcd
