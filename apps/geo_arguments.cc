// SPDX-License-Identifier: BSD-3-Clause
#include "geo_arguments.h"

namespace sslcd::apps {

void GeoArguments::AddTo(CLI::App& command, const std::string& use) {
  CLI::Option* where = command.add_option(
      "--origin", origin,
      "LATITUDE,LONGITUDE of the first camera in degrees, or LATITUDE,LONGITUDE,ALTITUDE with "
      "metres; " +
          use);
  command
      .add_option("--heading", heading_deg,
                  "where the first camera looks, in degrees clockwise from north")
      ->needs(where)
      ->capture_default_str();
}

std::optional<GeoOrigin> GeoArguments::Origin() const {
  if (!origin) return std::nullopt;
  return ParseGeoOrigin(*origin, heading_deg);
}

}  // namespace sslcd::apps
