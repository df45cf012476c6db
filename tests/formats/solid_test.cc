// SPDX-License-Identifier: BSD-3-Clause
#include "formats/solid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// By the divergence theorem; negative if the faces are seen from inside.
double Volume(const Solid& solid) {
  double volume = 0;
  for (const std::vector<int>& face : solid.faces)
    for (std::size_t i = 2; i < face.size(); ++i) {
      const Vec3 &a = solid.corners[face[0]], &b = solid.corners[face[i - 1]],
                 &c = solid.corners[face[i]];
      volume += a.dot(b.cross(c)) / 6;
    }
  return volume;
}

TEST(Solid, FacesEncloseTheVolumeAndAreSeenFromOutside) {
  EXPECT_NEAR(Volume(UnitBox()), 1, 1e-12);
  EXPECT_NEAR(Volume(UnitCylinder()), 14 * std::sin(2 * M_PI / 14) / 8, 1e-12);
}

TEST(Solid, FillsTheUnitCubeAboutTheOrigin) {
  for (const Solid& solid : {UnitBox(), UnitCylinder()}) {
    Vec3 low(0, 0, 0), high(0, 0, 0);
    for (const Vec3& corner : solid.corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    EXPECT_LT((high - Vec3(.5, .5, .5)).cwiseAbs().maxCoeff(), .02);
    EXPECT_LT((low + high).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace sslcd
