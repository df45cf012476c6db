// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "formats/colour.h"
#include "report/run_view.h"

namespace sslcd {

/// What is exported of a run, as named shapes in the world, in the colours of reports.
struct RunScene {
  struct Object {
    std::string name;  ///< "Car 12", by label and id
    Colour colour;
    bool round = false;
    MapObject object;
  };
  struct Path {
    std::string name;
    Colour colour;
    std::vector<Vec3> points;  ///< one at least
  };
  struct Loop {
    std::string name;  ///< "loop 380 to 23", by the frames of query and match
    Colour colour;     ///< by the change of viewpoint
    Vec3 query, match;
    LoopClosure loop;
  };
  std::string name;  ///< of the sequence; "run" if run.json has none
  GravityFrame gravity;
  Pose T_world_first;           ///< the first camera of the corrected trajectory
  std::vector<Object> objects;  ///< confirmed ones, by label
  std::vector<Path> paths;      ///< odometry, corrected trajectory, ground truth if there is one
  std::vector<Loop> loops;      ///< accepted ones
};

/// Throws Error(kBadInput) if the run has no poses, or if anything is farther than 1000 km from the
/// first camera.
RunScene SceneOf(const RunView& run);

}  // namespace sslcd
