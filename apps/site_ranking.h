// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/datasets/dataset.h"
#include "sslcd/retrieval/site_index.h"

namespace sslcd::apps {

/// A site that a drive may be from.
struct RankedSite {
  SiteCandidate best;  ///< of the stretch with the highest score
  double score = 0;    ///< sum over the stretches [nats]
  int stretches = 0;   ///< that have it among their candidates
};

/// Maps the frames without loops, cuts the drive into stretches of 100 m of path, and adds up what
/// the index says of each. Best first, at most `most`; none if no stretch agrees with any site.
std::vector<RankedSite> RankSites(const SiteIndex& index, const Dataset& dataset,
                                  const std::vector<Frame>& frames, int most);

}  // namespace sslcd::apps
