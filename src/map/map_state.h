// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/frame_store.h"
#include "map/object_map.h"

namespace sslcd {

/// The state of a run: its frames and the map of objects. Copyable.
struct MapState {
  ObjectMap map;
  FrameStore frames;

  const GravityFrame& gravity() const { return map.gravity(); }
};

}  // namespace sslcd
