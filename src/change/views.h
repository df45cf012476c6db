// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "change/places.h"

namespace sslcd {

/// A frame in which a place lies before the camera, within the detector's range.
struct View {
  double stamp = 0;  ///< [s]
  float range_m = 0, bearing_rad = 0;
  float visible = 0;  ///< share that nothing nearer hides
  bool seen = false;
};
/// The views of a place in one session, in order.
using Views = std::vector<View>;

/// The views of each place in each session: `[place][session]`. What the session has seen at other
/// places hides a place, and so do detections of no landmark. Views are left out where the detector
/// hardly ever sees anything: beyond its range, beside its field of view, on other storeys.
/// O(frames * n^2) with n places in range.
std::vector<std::vector<Views>> CollectViews(const Sightings& sightings,
                                             const std::vector<Place>& places);

}  // namespace sslcd
