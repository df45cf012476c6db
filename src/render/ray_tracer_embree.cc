// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracer.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cstring>

#include "sslcd/core/error.h"

namespace sslcd::render {
namespace {

constexpr std::size_t kPacket = 8;

/// Reference-counted handle of Embree.
template <class Handle, void (*release)(Handle)>
struct Releaser {
  using pointer = Handle;
  void operator()(Handle handle) const { release(handle); }
};
using Device = std::unique_ptr<void, Releaser<RTCDevice, rtcReleaseDevice>>;
using SceneHandle = std::unique_ptr<void, Releaser<RTCScene, rtcReleaseScene>>;
using Geometry = std::unique_ptr<void, Releaser<RTCGeometry, rtcReleaseGeometry>>;

template <class T>
T* NewBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count));
}

SceneHandle MeshScene(RTCDevice device, const Mesh& mesh) {
  const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  using Corners = std::array<unsigned, 3>;
  using Point = std::array<float, 3>;
  auto* points = NewBuffer<Point>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                  mesh.points.size());
  auto* corners = NewBuffer<Corners>(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                     mesh.triangles.size());
  for (const Vec3f& point : mesh.points) *points++ = {point.x(), point.y(), point.z()};
  for (const auto& triangle : mesh.triangles) {
    std::transform(triangle.begin(), triangle.end(), (corners++)->begin(),
                   [](int i) { return unsigned(i); });
  }
  rtcCommitGeometry(geometry.get());
  SceneHandle scene(rtcNewScene(device));
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  return scene;
}

/// Columns of the 3x4 matrix, one after the other.
std::array<float, 12> Columns(const Pose& pose) {
  std::array<float, 12> columns;
  Eigen::Map<Eigen::Matrix<float, 3, 4>> matrix(columns.data());
  matrix.leftCols<3>() = pose.so3().matrix().cast<float>();
  matrix.col(3) = pose.translation().cast<float>();
  return columns;
}

/// Rays `first` and up to seven more; lanes without a ray are switched off.
template <class Packet>
std::array<int, kPacket> Load(const std::vector<Ray>& rays, std::size_t first, Packet& packet) {
  std::array<int, kPacket> valid;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const Ray& ray = rays[std::min(first + lane, rays.size() - 1)];
    valid[lane] = first + lane < rays.size() ? -1 : 0;
    packet.org_x[lane] = ray.origin.x();
    packet.org_y[lane] = ray.origin.y();
    packet.org_z[lane] = ray.origin.z();
    packet.dir_x[lane] = ray.direction.x();
    packet.dir_y[lane] = ray.direction.y();
    packet.dir_z[lane] = ray.direction.z();
    packet.tnear[lane] = 0;
    packet.tfar[lane] = ray.far;
    packet.time[lane] = 0;
    packet.mask[lane] = ~0u;
    packet.id[lane] = packet.flags[lane] = 0;
  }
  return valid;
}

#if RTC_VERSION_MAJOR >= 4
void Intersect(const int* valid, RTCScene scene, RTCRayHit8& packet) {
  rtcIntersect8(valid, scene, &packet, nullptr);
}
void Occluded(const int* valid, RTCScene scene, RTCRay8& packet) {
  rtcOccluded8(valid, scene, &packet, nullptr);
}
#else
RTCIntersectContext Context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}
void Intersect(const int* valid, RTCScene scene, RTCRayHit8& packet) {
  RTCIntersectContext context = Context();
  rtcIntersect8(valid, scene, &context, &packet);
}
void Occluded(const int* valid, RTCScene scene, RTCRay8& packet) {
  RTCIntersectContext context = Context();
  rtcOccluded8(valid, scene, &context, &packet);
}
#endif

}  // namespace

struct Scene::Impl {
  SceneHandle scene;
};
Scene::Scene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene::~Scene() = default;

void Scene::Trace(const std::vector<Ray>& rays, std::vector<Hit>& hits) const {
  hits.assign(rays.size(), {});
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    RTCRayHit8 packet;
    const auto valid = Load(rays, first, packet.ray);
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
    Intersect(valid.data(), impl_->scene.get(), packet);
    for (std::size_t lane = 0; lane < std::min(kPacket, rays.size() - first); ++lane) {
      if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
      hits[first + lane] = {packet.ray.tfar[lane], static_cast<int>(packet.hit.instID[0][lane]),
                            static_cast<int>(packet.hit.primID[lane]), packet.hit.u[lane],
                            packet.hit.v[lane]};
    }
  }
}

void Scene::Hidden(const std::vector<Ray>& rays, std::vector<char>& hidden) const {
  hidden.assign(rays.size(), 0);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    RTCRay8 packet;
    const auto valid = Load(rays, first, packet);
    Occluded(valid.data(), impl_->scene.get(), packet);
    for (std::size_t lane = 0; lane < std::min(kPacket, rays.size() - first); ++lane) {
      hidden[first + lane] = packet.tfar[lane] < 0;  // Embree's code for a blocked ray
    }
  }
}

struct RayTracer::Impl {
  Device device;
  std::vector<SceneHandle> meshes;
};

RayTracer::RayTracer(const std::vector<Mesh>& meshes) : impl_(new Impl) {
  impl_->device.reset(rtcNewDevice("threads=1"));
  if (!impl_->device) throw Error(ErrorKind::kUsage, "Embree cannot be used on this machine");
  for (const Mesh& mesh : meshes) impl_->meshes.push_back(MeshScene(impl_->device.get(), mesh));
}

RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer::~RayTracer() = default;

Scene RayTracer::MakeScene(const std::vector<Instance>& instances) const {
  auto scene = std::make_unique<Scene::Impl>();
  scene->scene.reset(rtcNewScene(impl_->device.get()));
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Geometry geometry(rtcNewGeometry(impl_->device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), impl_->meshes[instances[i].mesh].get());
    const std::array<float, 12> columns = Columns(instances[i].T_world_mesh);
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene->scene.get(), geometry.get(), static_cast<unsigned>(i));
  }
  rtcCommitScene(scene->scene.get());
  return Scene(std::move(scene));
}

}  // namespace sslcd::render
