// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "recorded_sessions.h"
#include "sslcd/closing/localisation.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

struct MapCamera {
  Pose truth, T_map_cam;
  bool copy = false;
};

// A map in a file of its own, with the true poses of its cameras.
struct JudgedMap {
  ReferenceMap reference;
  std::vector<MapCamera> cameras;

  template <class Distance>
  const MapCamera& Nearest(const Distance& distance) const {
    return *std::min_element(
        cameras.begin(), cameras.end(),
        [&](const MapCamera& a, const MapCamera& b) { return distance(a) < distance(b); });
  }
};

/// The map of some sessions, one after the other.
JudgedMap MapOf(const std::vector<Session>& sessions, const MapperContext& context);

/// Landmarks of the map that the stretch has seen twice, by true poses.
int Shared(const JudgedMap& map, const Session& stretch);

/// A session of its own: frames from 0 on, odometry from another origin.
Session Cut(const Session& drive, std::size_t from, std::size_t to, int turn, const Vec3& up);

}  // namespace sslcd
