// SPDX-License-Identifier: BSD-3-Clause
#include "formats/geo_plane.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

constexpr double kMetresOfDegree = 111132;  // at 45 degrees of latitude, along the meridian

TEST(GeoOrigin, HasTwoOrThreeNumbers) {
  const GeoOrigin flat = ParseGeoOrigin("49.5,-8.25", 120);
  EXPECT_EQ(flat.latitude_deg, 49.5);
  EXPECT_EQ(flat.longitude_deg, -8.25);
  EXPECT_EQ(flat.altitude_m, std::nullopt);
  EXPECT_EQ(flat.heading_deg, 120);
  EXPECT_EQ(ParseGeoOrigin("-33.9,151.2,-10.5", 0).altitude_m, -10.5);
  for (const char* text : {"", "1", "1,2,3,4", "1,x", "90,0", "-90,0", "0,181", "0,nan", "1,,2",
                           "1,2,", "1,2,inf", "1,2,1e6", "1e10,0", "1, 2"})
    ExpectError([&] { ParseGeoOrigin(text, 0); }, {"LATITUDE,LONGITUDE", "is no origin"});
  for (const double heading : {361., -1e9, std::nan("")})
    ExpectError([&] { ParseGeoOrigin("1,2", heading); }, {"clockwise from north"});
}

TEST(GeoPlane, AheadIsTheHeading) {
  const Pose start(lie::SO3<double>::RotY(.7), Vec3(100, 5, 200));
  for (const auto& [heading, east, north] :
       {std::tuple{0., 0., 1.}, std::tuple{90., 1., 0.}, std::tuple{-180., 0., -1.}}) {
    const GeoPlane plane({45, 10, std::nullopt, heading}, start, Vec3(0, -1, 0));
    const GeoPoint ahead = plane.At(start * Vec3(0, -3, 1000));
    EXPECT_NEAR((ahead.latitude_deg - 45) * kMetresOfDegree, 1000 * north, .1);
    EXPECT_NEAR((ahead.longitude_deg - 10) * 78847, 1000 * east, .1);
    EXPECT_EQ(ahead.altitude_m, std::nullopt);
  }
}

// On the ellipsoid, from the centre of the Earth. [m]
Vec3 Geocentric(double latitude_deg, double longitude_deg) {
  const double latitude = latitude_deg * M_PI / 180, longitude = longitude_deg * M_PI / 180;
  constexpr double kEccentricity2 = 6.69437999014e-3;
  const double across = 6378137 / std::sqrt(1 - kEccentricity2 * std::pow(std::sin(latitude), 2));
  return across * Vec3(std::cos(latitude) * std::cos(longitude),
                       std::cos(latitude) * std::sin(longitude),
                       (1 - kEccentricity2) * std::sin(latitude));
}

TEST(GeoPlane, IsOffByNineMetresAtTenKilometres) {
  const GeoPlane plane({45, 0, std::nullopt, 0}, Pose(), Vec3(0, -1, 0));
  const Vec3 north(-std::sqrt(.5), 0, std::sqrt(.5)), east(0, 1, 0);
  double most = 0;
  for (int i = 0; i < 64; ++i) {
    const double x = 1e4 * std::sin(i * M_PI / 32), z = 1e4 * std::cos(i * M_PI / 32);
    const GeoPoint point = plane.At(Vec3(x, 0, z));
    const Vec3 there = Geocentric(point.latitude_deg, point.longitude_deg) - Geocentric(45, 0);
    most = std::max(most, std::hypot(there.dot(east) - x, there.dot(north) - z));
  }
  EXPECT_NEAR(most, 9, .5);
}

TEST(GeoPlane, AltitudeIsAlongUp) {
  const GeoPlane plane({45, 10, 115., 0}, Pose::Trans(7, 8, 9), Vec3(0, 0, 1));
  EXPECT_EQ(plane.At(Vec3(7, 8, 12)).altitude_m, 118);
}

TEST(GeoPlane, MapsThatDoNotFitOnTheEarth) {
  const GeoPlane plane({89, 0, std::nullopt, 0}, Pose(), Vec3(0, -1, 0));
  ExpectError([&] { plane.At(Vec3(0, 0, 2e5)); }, {"too large"});
  ExpectError([&] { plane.At(Vec3(1e9, 0, 0)); }, {"too large"});
  ExpectError([&] { plane.At(Vec3(NAN, 0, 0)); }, {"too large"});
}

TEST(GeoPlane, ACameraThatLooksDownHasSomeHeading) {
  const GeoPlane plane({45, 10, std::nullopt, 0}, Pose(), Vec3(0, 0, -1));
  EXPECT_NEAR(
      (plane.At(GravityFrame::FromUp(Vec3(0, 0, -1)).forward).latitude_deg - 45) * kMetresOfDegree,
      1, .01);
}

}  // namespace
}  // namespace sslcd
