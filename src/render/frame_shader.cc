// SPDX-License-Identifier: BSD-3-Clause
#include "render/frame_shader.h"

#include <Eigen/Geometry>

namespace sslcd::render {
namespace {

std::vector<Instance> InstancesOf(const std::vector<SceneModel::SceneObject>& objects) {
  std::vector<Instance> instances;
  for (const SceneModel::SceneObject& object : objects) instances.push_back(object.instance);
  return instances;
}

}  // namespace

FrameShader::FrameShader(const SceneModel& model, const RayTracer& tracer, const Daylight& light,
                         int frame, float pixel_angle)
    : model_(model),
      light_(light),
      objects_(model.ObjectsAt(frame)),
      contact_shadow_(model, objects_),
      scene_(tracer.MakeScene(InstancesOf(objects_))),
      pixel_angle_(pixel_angle) {
  for (const SceneModel::SceneObject& object : objects_) {
    axes_.push_back(object.instance.T_world_mesh.so3().matrix().cast<float>());
    origins_.push_back(object.instance.T_world_mesh.translation().cast<float>());
  }
}

std::vector<Sample> FrameShader::TraceRays(const std::vector<Ray>& rays) const {
  std::vector<Hit> hits;
  scene_.Trace(rays, hits);
  std::vector<Point> points(rays.size());
  std::vector<Ray> to_sun(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].instance < 0) continue;  // no ray to the sun
    points[i] = PointOf(rays[i], hits[i]);
    // offset against self-intersection by rounding
    const float off = 0.003f + 1e-4f * hits[i].distance;
    to_sun[i] = {points[i].position + off * points[i].face_normal, light_.to_sun,
                 points[i].face_normal.dot(light_.to_sun) > 0 ? kFar : 0};
  }
  std::vector<char> hidden;
  scene_.Hidden(to_sun, hidden);
  std::vector<Sample> samples(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].instance < 0) {
      samples[i].colour = SkyColour(light_, rays[i].direction.normalized());
    } else {
      samples[i] = SampleOf(rays[i], hits[i], points[i], to_sun[i].far > 0 && !hidden[i]);
    }
  }
  return samples;
}

FrameShader::Point FrameShader::PointOf(const Ray& ray, const Hit& hit) const {
  const Mesh& mesh = MeshOf(hit);
  const auto& [a, b, c] = mesh.triangles[hit.triangle];
  const auto& normals = mesh.normals[hit.triangle];
  const Vec3f flat = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
  const Vec3f round = (1 - hit.u - hit.v) * normals[0] + hit.u * normals[1] + hit.v * normals[2];
  Point point{ray.origin + hit.distance * ray.direction,
              axes_[hit.instance] * flat.stableNormalized(),
              axes_[hit.instance] * round.stableNormalized()};
  if (point.face_normal.dot(ray.direction) > 0) point.face_normal = -point.face_normal;
  if (point.normal.dot(point.face_normal) < 0) point.normal = -point.normal;
  return point;
}

Sample FrameShader::SampleOf(const Ray& ray, const Hit& hit, const Point& point, bool lit) const {
  const SceneModel::SceneObject& object = objects_[hit.instance];
  const Eigen::Matrix3f& axes = axes_[hit.instance];
  const float length = ray.direction.norm(), distance = hit.distance * length;
  const Vec3f view = ray.direction / length;
  const int part = MeshOf(hit).parts[hit.triangle];
  // At a grazing angle a pixel covers a long and narrow area; this is the mean of both extents.
  const float footprint =
      pixel_angle_ * distance / std::sqrt(std::max(-point.face_normal.dot(view), 0.02f));
  const Surface surface =
      model_.SurfaceOf(object, {axes.transpose() * (point.position - origins_[hit.instance]),
                                axes.transpose() * point.normal, part, footprint});
  const bool from_behind = surface.translucent && point.normal.dot(light_.to_sun) < 0;
  const Vec3f normal = from_behind ? Vec3f(-0.6f * point.normal) : point.normal;
  const float open =
      object.kind == SceneModel::Kind::kGround ? contact_shadow_.VisibleSky(point.position) : 1;

  Sample sample;
  sample.colour =
      ApplyHaze(light_, Shade(light_, surface, normal, view, lit ? 1 : 0, open), distance);
  sample.depth = hit.distance;
  sample.identity = object.identity;
  const std::uint32_t painted = surface.translucent
                                    ? 0  // leaves have too many edges to smooth
                                    : static_cast<std::uint32_t>(2 * surface.kind + (lit ? 1 : 0));
  const std::uint32_t building =
      object.kind == SceneModel::Kind::kTown ? static_cast<std::uint32_t>(part) : 0;
  sample.key = (static_cast<std::uint32_t>(hit.instance + 1) << 16) + (building << 5) + painted;
  return sample;
}

}  // namespace sslcd::render
