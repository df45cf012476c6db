// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sslcd/retrieval/site_index.h"

namespace sslcd {

/// A site as it is, and a path through it.
struct GeneratedSite {
  std::vector<SiteObject> objects;
  std::vector<SiteObject> path;  ///< a point each metre, 75 to 100 m; without labels
  double sight_m = 12;           ///< how far from the path objects are seen
};

/// Kinds of sites: "lot": rows of stalls of 2.5 m across aisles, 60 % taken, cars, 12 % vans and 8
/// % trucks; "same": the same with cars only; "street": cars along both kerbs of a winding street,
/// poles and trees behind them; "trees": trees by chance, 60 to 300 a hectare.
extern const std::vector<std::string> kSiteKinds;

/// Makes a site of about 100 to 1000 objects, by seed. Throws Error(kUsage) for another kind.
GeneratedSite MakeSite(const std::string& kind, std::uint64_t seed);

/// The map of a site: 5 % of the objects are missing, the others 0.1 m off.
Site MapOfSite(const GeneratedSite& site, const std::string& name, std::uint64_t seed);

/// What is wrong with a stretch of a drive.
struct StretchNoise {
  std::string name;
  double position_m = 0.3;  ///< standard deviation of an object's place, each axis
  double missed = 0.15;     ///< share of the objects
  double false_ones = 0.1;  ///< per object
  double other_label = 0.03;
  double scale = 0.02;           ///< standard deviation of the odometry's
  double bend_rad_per_m = 2e-4;  ///< standard deviation of the drift of its heading
};

/// What a drive along the path has mapped: objects within sight, in a frame of any heading.
struct GeneratedStretch {
  std::vector<SiteObject> objects;
  SiteCandidate truth;  ///< pose in the site, exact in the middle of the path
};
GeneratedStretch DriveThrough(const GeneratedSite& site, const StretchNoise& noise,
                              std::uint64_t seed);

}  // namespace sslcd
