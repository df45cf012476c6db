// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/ground_check.h"

#include <cmath>

namespace sslcd {

void CheckGround(const StereoView& images, const StereoCamera& camera,
                 const std::vector<Detection>& objects, const GroundOptions& options,
                 GroundReport& report) {
  constexpr int kSearched = 5;   // largest number of frames searched at other heights; set by hand
  constexpr double kSigmas = 3;  // of the given height; set by hand
  std::vector<Box2d> boxes;
  for (const Detection& object : objects)
    if (object.box) boxes.push_back(*object.box);
  ++report.frames;
  const GroundPlane plane = EstimateGround(images, camera, boxes, options);
  if (plane.support >= kGroundSupport &&
      std::abs(plane.height_m - options.height_m) <= kSigmas * options.height_sigma_m)
    return;
  ++report.elsewhere;
  if (report.elsewhere > kSearched) return;
  if (const auto height = FindGroundHeight(images, camera, boxes, options))
    report.heights_m.push_back(*height);
}

}  // namespace sslcd
