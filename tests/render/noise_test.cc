// SPDX-License-Identifier: BSD-3-Clause
#include "render/noise.h"

#include <gtest/gtest.h>

namespace sslcd::render {
namespace {

TEST(Noise, IsContinuousAlsoAcrossZero) {
  for (float x = -2; x < 2; x += 0.01f) {
    EXPECT_NEAR(ValueNoise(x, 0.3f, 1), ValueNoise(x + 0.01f, 0.3f, 1), 0.03);
    EXPECT_NEAR(CellNoise(x, -0.7f, 1).border, CellNoise(x + 0.01f, -0.7f, 1).border, 0.03);
  }
}

TEST(Noise, FinerThanAPixelFadesOut) {
  EXPECT_NE(Fractal(0.3f, 0.4f, 1, {10, 4}, 0.001f), 0);
  EXPECT_EQ(Fractal(0.3f, 0.4f, 1, {10, 4}, 0.2f), 0);
}

TEST(Noise, OtherSeedsAreOtherNumbers) {
  EXPECT_NE(ValueNoise(0.5f, 0.5f, 1), ValueNoise(0.5f, 0.5f, 2));
  EXPECT_EQ(ValueNoise(0.5f, 0.5f, 1), ValueNoise(0.5f, 0.5f, 1));
}

TEST(Band, IsTheShareOfThePixel) {
  EXPECT_NEAR(Band(0, 0.1f, 0.01f), 1, 1e-6);
  EXPECT_NEAR(Band(0, 0.1f, 0.4f), 0.5, 1e-6);
  EXPECT_NEAR(Band(0.1f, 0.1f, 0.01f), 0.5, 1e-5);
  EXPECT_EQ(Band(0.2f, 0.1f, 0.01f), 0);
}

}  // namespace
}  // namespace sslcd::render
