// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_run.h"

namespace sslcd {
namespace {

using testing::HasSubstr;

TEST(RunPly, ObjectsAreFacesPathsAndLoopsAreEdges) {
  const std::string text = RunPly(SceneOf(SmallRun()));
  EXPECT_THAT(text, HasSubstr("\ncomment sslcd, metres, up: 0 -1 0\nelement vertex 44\n"))
      << "8 of the car, 28 of the tree, 2 paths of 3, 2 of the loop";
  EXPECT_THAT(text, HasSubstr("element face 22\n"));
  EXPECT_THAT(text, HasSubstr("element edge 5\n"));
  EXPECT_THAT(text, HasSubstr("\n500.0000 -200.0000 320.0000 0 114 178\n")) << "in the world";
  EXPECT_THAT(text, testing::EndsWith("\n42 43 254 232 56\n")) << "seen from the opposite side";
}

}  // namespace
}  // namespace sslcd
