// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "render/mesh.h"
#include "sslcd/core/pose.h"

namespace sslcd::render {

struct Ray {
  Vec3f origin, direction;
  float far = 0;  ///< in lengths of `direction`
};

struct Hit {
  float distance = 0;  ///< in lengths of the ray's direction
  int instance = -1;   ///< number in the list the scene was made of; -1: nothing hit
  int triangle = 0;
  float u = 0, v = 0;  ///< weights of the triangle's second and third corner
};

/// A mesh somewhere in the world.
struct Instance {
  int mesh = 0;
  Pose T_world_mesh;
};

/// What stands where at one time. Its functions may be called from several threads.
class Scene {
 public:
  struct Impl;
  explicit Scene(std::unique_ptr<Impl> impl);
  Scene(Scene&&) noexcept;
  ~Scene();

  /// The nearest hit of each ray; neighbours in the list should be neighbours in the image.
  void Trace(const std::vector<Ray>& rays, std::vector<Hit>& hits) const;

  /// Whether anything is on the ray's way: 1 or 0.
  void Hidden(const std::vector<Ray>& rays, std::vector<char>& hidden) const;

 private:
  std::unique_ptr<Impl> impl_;
};

/// The one place that knows Embree. Starts no threads.
class RayTracer {
 public:
  /// throws Error(kUsage) where Embree is absent
  explicit RayTracer(const std::vector<Mesh>& meshes);
  RayTracer(RayTracer&&) noexcept;
  ~RayTracer();
  Scene MakeScene(const std::vector<Instance>& instances) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd::render
