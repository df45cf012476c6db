// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "retrieval/site_file.h"
#include "retrieval/site_point.h"

namespace sslcd {

/// How well a stretch agrees with a site under a pose.
struct SiteFit {
  FlatPose pose;    ///< aligned
  float score = 0;  ///< log likelihood ratio against objects by chance [nats]
  int matches = 0;
};

/// Aligns the stretch with the objects of the site near it, and scores the result. `points` have
/// their origin in their middle. `site` is sorted by x. O(objects of the site in a strip as wide as
/// the stretch)
SiteFit FitSite(const std::vector<SitePoint>& points, const Span<SitePoint>& site,
                const FlatPose& start);

}  // namespace sslcd
