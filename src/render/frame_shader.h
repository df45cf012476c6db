// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/contact_shadow.h"
#include "render/light.h"
#include "render/ray_tracer.h"
#include "render/scene_model.h"

namespace sslcd::render {

/// The result of one ray.
struct Sample {
  Vec3f colour = Vec3f::Zero();
  float depth = 0;  ///< in units of the ray's direction; 0: sky
  int identity = -1;
  std::uint32_t key = 0;  ///< surface and shadow; no smoothing between neighbours of equal key
};

/// The scene at one frame, in one light.
class FrameShader {
 public:
  static constexpr float kFar = 2000;

  /// `pixel_angle`: angle of a pixel in the middle of the image [rad]. Keeps references to the
  /// other arguments.
  FrameShader(const SceneModel& model, const RayTracer& tracer, const Daylight& light, int frame,
              float pixel_angle);

  /// Casts the rays, and a second ray from each hit to the sun.
  std::vector<Sample> TraceRays(const std::vector<Ray>& rays) const;

 private:
  /// A point of a surface, in the scene's frame.
  struct Point {
    Vec3f position = Vec3f::Zero(), face_normal = Vec3f::UnitZ(),
          normal = Vec3f::UnitZ();  ///< normals of the triangle, of the shape
  };
  Point PointOf(const Ray& ray, const Hit& hit) const;
  Sample SampleOf(const Ray& ray, const Hit& hit, const Point& point, bool lit) const;
  const Mesh& MeshOf(const Hit& hit) const {
    return model_.meshes()[objects_[hit.instance].instance.mesh];
  }

  const SceneModel& model_;
  const Daylight& light_;
  std::vector<SceneModel::SceneObject> objects_;
  std::vector<Eigen::Matrix3f> axes_;  ///< rotations of the meshes in the scene
  std::vector<Vec3f> origins_;
  ContactShadow contact_shadow_;
  Scene scene_;
  float pixel_angle_;
};

}  // namespace sslcd::render
