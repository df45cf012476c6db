// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "formats/geo_plane.h"

namespace sslcd::apps {

/// --origin and --heading, shared by several subcommands.
struct GeoArguments {
  std::optional<std::string> origin;
  double heading_deg = 0;

  /// `use` says what the origin does.
  void AddTo(CLI::App& command, const std::string& use);
  /// None if no origin was given. Throws Error(kUsage).
  std::optional<GeoOrigin> Origin() const;
};

}  // namespace sslcd::apps
