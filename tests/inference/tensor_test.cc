// SPDX-License-Identifier: BSD-3-Clause
#include "inference/tensor.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(Tensor, ShapesAsText) {
  EXPECT_EQ(ToString(TensorShape{1, 3, -1, 352}), "1x3x?x352");
  EXPECT_EQ(ToString(TensorShape{}), "scalar");
}

TEST(Tensor, CountsElements) {
  EXPECT_EQ(ElementCount({2, 3, 4}), 24u);
  EXPECT_EQ(ElementCount({2, 0}), 0u);
  EXPECT_EQ(ElementCount({}), 1u);
}

TEST(Tensor, UnknownSizesFitAnything) {
  EXPECT_TRUE(Fits({1, -1, 85}, {1, 25200, 85}));
  EXPECT_TRUE(Fits({1, 25200, 85}, {1, -1, 85}));
  EXPECT_FALSE(Fits({1, 25200, 85}, {1, -1, 9}));
  EXPECT_FALSE(Fits({25200, 85}, {1, -1, 85}));
}

}  // namespace
}  // namespace sslcd
