// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "sslcd/closing/localisation.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

struct Options;

/// Finds a drive in a finished map, without any prior pose, and does not change the map. The last
/// metres of the drive are a local map, as in the search for loops, which is compared with the
/// whole map every LoopLayoutOptions::every_m of path. Attempts add up: a pose is accepted under
/// the rules of a loop that joins two sequences (docs/decision.md), since no odometry leads to the
/// map.
///
/// Keeps the frames of the drive; begin another Localiser for another drive. Not thread-safe.
class Localiser {
 public:
  /// Copies the map. Throws what Mapper's constructor throws, and Error(kBadInput) if the map has
  /// no objects, two with one id, or one without a label. O(objects log objects).
  Localiser(const ReferenceMap& map, const Options& options,
            const std::optional<Camera>& camera = std::nullopt);
  ~Localiser();
  Localiser(Localiser&&) noexcept;
  Localiser& operator=(Localiser&&) noexcept;

  /// Adds the next frame in order of time. Returns an answer about it if an attempt was made.
  /// Throws what Mapper::AddFrame throws.
  std::optional<Localisation> AddFrame(const Frame& frame);

  /// An attempt from the newest frame at once, however short the path: e.g. of a robot that stands.
  /// Throws Error(kUsage) if there is no frame yet.
  Localisation Attempt();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
