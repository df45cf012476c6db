// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "render/ground.h"
#include "render/ray_tracer.h"
#include "render/town.h"

namespace sslcd::render {

/// The scene without light: the meshes of all objects and of their surroundings, with their paint.
class SceneModel {
 public:
  SceneModel(const sim::HalvWorld& scene, std::uint32_t seed);

  enum class Kind { kGround, kTown, kTree, kPole, kVehicle, kWheelStop };
  struct SceneObject {
    Instance instance;
    Kind kind = Kind::kGround;
    int identity = -1;  ///< WorldObject::id
    std::uint32_t seed = 0;
  };

  /// All meshes at a frame.
  std::vector<SceneObject> ObjectsAt(int frame) const;
  Surface SurfaceOf(const SceneObject& object, const SurfacePoint& point) const;

  const sim::World& world() const { return world_; }
  const UsedArea& used() const { return used_; }
  const Pose& T_scene_world() const { return T_scene_world_; }
  const std::vector<Mesh>& meshes() const { return meshes_; }

 private:
  void AddObjects(std::uint32_t seed);
  void AddSurroundings(std::uint32_t seed);
  void AddWheelStops(const std::vector<sim::ParkingSpace>& spaces, std::uint32_t seed);

  sim::World world_;
  Pose T_scene_world_;
  UsedArea used_;
  Town town_;
  Ground ground_;
  std::vector<Mesh> meshes_;
  std::vector<CarShape> shapes_;      ///< by identity; empty ones for poles and trees
  std::vector<SceneObject> objects_;  ///< by identity; without pose
  std::vector<SceneObject> surroundings_;
};

}  // namespace sslcd::render
