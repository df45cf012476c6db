// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/gltf.h"

#include <gtest/gtest.h>

#include <cstring>

namespace sslcd {
namespace {

using Json = GltfBuilder::Json;

std::uint32_t Word(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) word = word << 8 | static_cast<std::uint8_t>(bytes.at(at + i));
  return word;
}

float Float(const std::string& bytes, std::size_t at) {
  const std::uint32_t word = Word(bytes, at);
  float value = 0;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

struct Glb {
  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(Word(bytes, 4), 2u);
    EXPECT_EQ(Word(bytes, 8), bytes.size());
    const std::uint32_t size = Word(bytes, 12);
    EXPECT_EQ(size % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    json = Json::parse(bytes.substr(20, size));
    EXPECT_EQ(bytes.substr(24 + size, 4), std::string("BIN\0", 4));
    binary = bytes.substr(28 + size);
    EXPECT_EQ(Word(bytes, 20 + size), binary.size());
    EXPECT_EQ(json["buffers"][0]["byteLength"], binary.size());
  }
  Json json;
  std::string binary;
};

TEST(Gltf, ChunksAreAlignedWhateverTheLengthOfTheText) {
  for (const char* name : {"", "a", "ab", "abc"}) {
    GltfBuilder builder;
    builder.AddNode({{"name", name}, {"mesh", builder.AddPath({Vec3(1, 2, 3), Vec3(4, 5, 6)}, 0)}});
    const Glb glb(builder.Bytes());
    EXPECT_EQ(glb.json["nodes"][0]["name"], name);
    EXPECT_EQ(glb.binary.size(), 24u);
    EXPECT_EQ(Float(glb.binary, 20), 6);
  }
}

TEST(Gltf, RangesAreThoseOfTheStoredNumbers) {
  GltfBuilder builder;
  builder.AddPath({Vec3(.1, -7, 1e5 + .001)}, 0);  // none of them is a float, but -7
  const Glb glb(builder.Bytes());
  const Json& accessor = glb.json["accessors"][0];
  EXPECT_EQ(accessor["count"], 2) << "a line has two points";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(accessor["min"][axis].get<double>(), Float(glb.binary, 4 * axis));
    EXPECT_EQ(accessor["max"][axis], accessor["min"][axis]);
  }
}

TEST(Gltf, SolidsHaveFlatFaces) {
  GltfBuilder builder;
  builder.AddSolid(UnitBox(), builder.AddMaterial("red", {255, 0, 0}));
  const Glb glb(builder.Bytes());
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  EXPECT_EQ(glb.json["accessors"][primitive["attributes"]["NORMAL"].get<int>()]["count"], 24);
  EXPECT_EQ(glb.json["accessors"][primitive["indices"].get<int>()]["count"], 36);
  // all corners of a face lie where its normal points
  for (std::size_t i = 0; i < 24; ++i) {
    double along = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      along += Float(glb.binary, 12 * i + 4 * axis) * Float(glb.binary, 12 * (24 + i) + 4 * axis);
    EXPECT_NEAR(along, .5, 1e-6);
  }
}

TEST(Gltf, LinesHaveTheirColours) {
  GltfBuilder builder;
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
  builder.AddLines(points, {{255, 0, 0}, {0, 128, 0}},
                   builder.AddLineMaterial("loops", {255, 255, 255}));
  const Glb glb(builder.Bytes());
  EXPECT_EQ(glb.json["meshes"][0]["primitives"][0]["mode"], 1);
  EXPECT_TRUE(glb.json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  EXPECT_EQ(Float(glb.binary, 48 + 12), 1) << "red of the second end";
  EXPECT_FLOAT_EQ(Float(glb.binary, 48 + 28), .215861F);
}

TEST(Gltf, ColoursAreLinear) {
  EXPECT_EQ(LinearColour({0, 255, 128}), Vec3(0, 1, .215861));
  EXPECT_EQ(LinearColour({5, 0, 0}).x(), .001518) << "the linear part of the curve";
}

}  // namespace
}  // namespace sslcd
