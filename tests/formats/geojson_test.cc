// SPDX-License-Identifier: BSD-3-Clause
#include "formats/geojson.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(GeoJsonText, PointsLinesAndPolygons) {
  using Kind = GeoFeature::Kind;
  const GeoPoint a{8.5, 49, std::nullopt}, b{8.5, 49.25, 115.5}, c{9, 49, std::nullopt};
  const std::string text = GeoJsonText({{Kind::kPoint, {b}, {{"name", "a \"b\""}, {"count", 3.}}},
                                        {Kind::kLine, {a}, {}},
                                        {Kind::kPolygon, {a, c, b}, {}}});
  EXPECT_EQ(text,
            R"({"type":"FeatureCollection","features":[
{"type":"Feature","geometry":{"type":"Point","coordinates":[8.5,49.25,115.5]},"properties":{"name":"a \"b\"","count":3}},
{"type":"Feature","geometry":{"type":"LineString","coordinates":[[8.5,49],[8.5,49]]},"properties":{}},
{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[8.5,49],[9,49],[8.5,49.25,115.5],[8.5,49]]]},"properties":{}}
]}
)");
  EXPECT_EQ(GeoJsonText({}), "{\"type\":\"FeatureCollection\",\"features\":[\n]}\n");
}

}  // namespace
}  // namespace sslcd
