// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "retrieval/site_file.h"
#include "sslcd/retrieval/site_index.h"

namespace sslcd {

/// SiteIndex::Find.
std::vector<SiteCandidate> FindSites(const SiteFile& file, const std::vector<SiteObject>& stretch,
                                     int most);

}  // namespace sslcd
