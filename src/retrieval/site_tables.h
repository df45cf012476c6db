// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "retrieval/site_file.h"
#include "retrieval/site_point.h"
#include "sslcd/retrieval/site_index.h"

namespace sslcd {

/// The sites of an index that is being made.
struct SiteTables {
  struct Row {
    std::string name;
    double x = 0, y = 0;  ///< origin of its points [m]
    std::size_t first_point = 0;
  };
  std::vector<Row> sites;
  std::set<std::string> names;
  std::map<std::string, std::uint16_t> labels;  ///< numbers in order of appearance
  std::vector<SitePoint> points;
};

/// Adds a site. Throws Error(kBadInput), and leaves the tables as they were: see SiteIndex::Build.
void AddSite(const Site& site, SiteTables& tables);
/// Adds all sites of a file, with the bytes that they have there. Throws likewise.
void AddSites(const SiteFile& file, SiteTables& tables);

/// The bytes of the file.
std::string SiteFileBytes(const SiteTables& tables);

}  // namespace sslcd
