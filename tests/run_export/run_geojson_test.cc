// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_geojson.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "small_run.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;

TEST(RunGeoJson, IsTheSameForEachUpAxis) {
  const GeoOrigin origin{45, 10, 100., 30};
  const std::string text = RunGeoJson(SceneOf(SmallRun()), origin);
  EXPECT_EQ(RunGeoJson(SceneOf(SmallRun(Vec3(0, 0, 1))), origin), text);
  EXPECT_EQ(RunGeoJson(SceneOf(SmallRun(Vec3(1, 0, 0))), origin), text);
}

TEST(RunGeoJson, FeaturesHaveNamesAndProperties) {
  const Json features =
      Json::parse(RunGeoJson(SceneOf(SmallRun()), {45, 10, std::nullopt, 0}))["features"];
  ASSERT_EQ(features.size(), 5u) << "two paths, two objects, a loop";
  EXPECT_EQ(features[0]["properties"], Json({{"name", "odometry"}, {"stroke", "#d55e00"}}));
  EXPECT_EQ(features[1]["geometry"]["coordinates"][0], Json({10., 45.}));
  EXPECT_EQ(features[2]["properties"]["name"], "Car 12");
  EXPECT_EQ(features[2]["properties"]["length_m"], 4.);
  EXPECT_EQ(features[2]["properties"]["sightings"], 2.);
  EXPECT_EQ(features[4]["properties"]["viewpoint_change_deg"], 180.);
  EXPECT_FALSE(features[4]["properties"].contains("probability"));
}

TEST(RunGeoJson, OutlinesAreClosedAndRunCounterClockwise) {
  const Json features =
      Json::parse(RunGeoJson(SceneOf(SmallRun()), {45, 10, std::nullopt, 77}))["features"];
  for (const auto& [feature, corners, area_m2] :
       {std::tuple{2, 4u, 4. * 2}, std::tuple{3, 14u, 14 * std::sin(2 * M_PI / 14) / 8 * 4 * 2}}) {
    const Json& ring = features[feature]["geometry"]["coordinates"][0];
    ASSERT_EQ(ring.size(), corners + 1);
    EXPECT_EQ(ring[0], ring[corners]);
    double area = 0;
    for (std::size_t i = 0; i < corners; ++i) {
      const auto east = [&](std::size_t k) { return (ring[k][0].get<double>() - 10) * 78847; };
      const auto north = [&](std::size_t k) { return (ring[k][1].get<double>() - 45) * 111132; };
      area += (east(i) * north(i + 1) - east(i + 1) * north(i)) / 2;
    }
    EXPECT_NEAR(area, area_m2, .01);
  }
}

}  // namespace
}  // namespace sslcd
