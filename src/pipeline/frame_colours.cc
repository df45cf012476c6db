// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/frame_colours.h"

#include <algorithm>

namespace sslcd {

bool LacksColour(const Frame& frame) {
  return !frame.image_left.empty() &&
         std::any_of(frame.detections.begin(), frame.detections.end(),
                     [](const auto& d) { return d.box && d.appearance[Cue::kColour].empty(); });
}

bool AddColours(Frame& frame, const ColourOptions& options, const RunHooks& hooks) {
  return hooks.with_image(frame.image_left, [&](const ImageView& image) {
    for (Detection& detection : frame.detections)
      if (detection.box && detection.appearance[Cue::kColour].empty())
        detection.appearance[Cue::kColour] = ColourVector(image, *detection.box, options);
  });
}

}  // namespace sslcd
