// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <utility>

#include "loop_drives.h"
#include "same_mappers.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
namespace {

// A host refines a copy in a thread of its own, while the original goes on.
TEST(MapperCopy, HasAllStateAndGoesItsOwnWay) {
  const Drives drives = TwoLaps(SecondLap::kOpposite, 0.5, 1);
  Mapper mapper({}, drives.Context()), undisturbed({}, drives.Context());
  const std::size_t half = drives.frames.size() * 3 / 4;
  for (std::size_t i = 0; i < half; ++i) {
    mapper.AddFrame(drives.frames[i]);
    undisturbed.AddFrame(drives.frames[i]);
  }
  Mapper copy = mapper;
  copy.Refine();
  EXPECT_NE(copy.CameraTrajectory().poses.back().translation(),
            mapper.CameraTrajectory().poses.back().translation());
  ExpectSame(mapper, undisturbed);
  for (std::size_t i = half; i < drives.frames.size(); ++i) {
    mapper.AddFrame(drives.frames[i]);
    undisturbed.AddFrame(drives.frames[i]);
  }
  ExpectSame(mapper, undisturbed);

  Mapper late = std::move(mapper);
  copy = late;
  copy.Refine();
  late.Refine();
  ExpectSame(copy, late);
}

}  // namespace
}  // namespace sslcd
