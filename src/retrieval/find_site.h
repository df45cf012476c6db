// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "retrieval/pose_votes.h"
#include "retrieval/site_file.h"
#include "sslcd/retrieval/site_index.h"

namespace sslcd {

/// SiteIndex::Find. `votes` is memory to work with, so that it is not asked for again and again.
std::vector<SiteCandidate> FindSites(const SiteFile& file, const std::vector<SiteObject>& stretch,
                                     int most, PoseVotes& votes);

/// The indices of the `most` highest scores, ascending; of equal scores the first ones.
std::vector<std::size_t> HighestScores(const std::vector<float>& scores, std::size_t most);

}  // namespace sslcd
