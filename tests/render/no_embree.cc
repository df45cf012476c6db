// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "render/ray_tracer.h"
#include "sslcd/core/error.h"

namespace sslcd::render {
namespace {

TEST(NoEmbree, SaysHowToGetIt) {
  try {
    RayTracer tracer({});
    FAIL() << "made a ray tracer of nothing";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_THAT(error.what(), testing::HasSubstr("libembree-dev"));
  }
}

}  // namespace
}  // namespace sslcd::render
