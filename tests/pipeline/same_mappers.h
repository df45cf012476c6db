// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

// The same results but for ids.
inline void ExpectSame(const Mapper& a, const Mapper& b) {
  const Trajectory one = a.CameraTrajectory(), other = b.CameraTrajectory();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    ASSERT_EQ(one.poses[i].matrix(), other.poses[i].matrix()) << i;
  EXPECT_EQ(a.Objects().size(), b.Objects().size());
  const auto loops = a.LoopClosures(), others = b.LoopClosures();
  ASSERT_EQ(loops.size(), others.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    EXPECT_EQ(loops[i].decision, others[i].decision);
    EXPECT_EQ(loops[i].score, others[i].score);
  }
}

}  // namespace sslcd
