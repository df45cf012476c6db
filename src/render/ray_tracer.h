// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "render/mesh.h"
#include "sslcd/core/pose.h"

namespace sslcd::render {

struct Ray {
  Vec3f origin, direction;
  float far = 0;  ///< in units of `direction`
};

struct Hit {
  float distance = 0;  ///< in units of the ray's direction
  int instance = -1;   ///< index into the list of instances; -1: no hit
  int triangle = 0;
  float u = 0, v = 0;  ///< weights of the triangle's second and third corner
};

/// A mesh with its pose in the world.
struct Instance {
  int mesh = 0;
  Pose T_world_mesh;
};

/// All meshes at one time. Its functions may be called from several threads.
class Scene {
 public:
  struct Impl;
  explicit Scene(std::unique_ptr<Impl> impl);
  Scene(Scene&&) noexcept;
  ~Scene();

  /// Finds the nearest hit of each ray. Neighbours in the list should be neighbours in the image.
  void Trace(const std::vector<Ray>& rays, std::vector<Hit>& hits) const;

  /// Whether a mesh blocks the ray: 1 or 0.
  void Hidden(const std::vector<Ray>& rays, std::vector<char>& hidden) const;

 private:
  std::unique_ptr<Impl> impl_;
};

/// The only code that uses Embree. Starts no threads.
class RayTracer {
 public:
  /// throws Error(kUsage) without Embree
  explicit RayTracer(const std::vector<Mesh>& meshes);
  RayTracer(RayTracer&&) noexcept;
  ~RayTracer();
  Scene MakeScene(const std::vector<Instance>& instances) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd::render
