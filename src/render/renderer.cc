// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/render/renderer.h"

#include <Eigen/Geometry>
#include <string>

#include "render/contact_shade.h"
#include "render/light.h"
#include "render/noise.h"
#include "render/sensor.h"
#include "render/stage_set.h"
#include "sslcd/core/error.h"
#include "sslcd/sim/check_fields.h"

namespace sslcd::render {
namespace {

constexpr float kFar = 2000;

/// What one ray brings home.
struct Sample {
  Vec3f colour = Vec3f::Zero();
  float depth = 0;
  int identity = -1;
  std::uint32_t key = 0;  ///< another one next to it: an edge to smooth
};

/// The world at one frame in one pass's light.
class Moment {
 public:
  Moment(const StageSet& set, const RayTracer& tracer, const Daylight& light, int frame, float pixel_angle)
      : set_(set),
        light_(light),
        things_(set.ThingsAt(frame)),
        shade_(set, things_),
        scene_(tracer.MakeScene(Instances())),
        pixel_angle_(pixel_angle) {
    for (const StageSet::Thing& thing : things_) {
      axes_.push_back(thing.instance.T_world_mesh.so3().matrix().cast<float>());
      origins_.push_back(thing.instance.T_world_mesh.translation().cast<float>());
    }
  }

  std::vector<Sample> Look(const std::vector<Ray>& rays) const {
    std::vector<Hit> hits;
    scene_.Trace(rays, hits);
    std::vector<Corner> corners(rays.size());
    std::vector<Ray> to_sun(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].instance >= 0) corners[i] = CornerOf(rays[i], hits[i]);
      to_sun[i] = {corners[i].at + (0.003f + 1e-4f * hits[i].distance) * corners[i].flat, light_.to_sun,
                   hits[i].instance >= 0 && corners[i].flat.dot(light_.to_sun) > 0 ? kFar : 0};
    }
    std::vector<char> hidden;
    scene_.Hidden(to_sun, hidden);
    std::vector<Sample> samples(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Vec3f view = rays[i].direction.normalized();
      if (hits[i].instance < 0) {
        samples[i].colour = SkyColour(light_, view);
        continue;
      }
      const bool lit = to_sun[i].far > 0 && !hidden[i];
      samples[i] = SampleOf(rays[i], hits[i], corners[i], view, lit);
    }
    return samples;
  }

 private:
  /// A point of a surface, in the scene's frame.
  struct Corner {
    Vec3f at = Vec3f::Zero(), flat = Vec3f::UnitZ(), normal = Vec3f::UnitZ();
  };

  std::vector<Instance> Instances() const {
    std::vector<Instance> instances;
    for (const StageSet::Thing& thing : things_) instances.push_back(thing.instance);
    return instances;
  }

  const Mesh& MeshOf(const Hit& hit) const { return set_.meshes()[things_[hit.instance].instance.mesh]; }

  Corner CornerOf(const Ray& ray, const Hit& hit) const {
    const Mesh& mesh = MeshOf(hit);
    const auto& [a, b, c] = mesh.triangles[hit.triangle];
    const auto& normals = mesh.normals[hit.triangle];
    Corner corner;
    corner.at = ray.origin + hit.distance * ray.direction;
    const Vec3f flat = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    const Vec3f round = (1 - hit.u - hit.v) * normals[0] + hit.u * normals[1] + hit.v * normals[2];
    corner.flat = axes_[hit.instance] * flat.stableNormalized();
    corner.normal = axes_[hit.instance] * round.stableNormalized();
    if (corner.flat.dot(ray.direction) > 0) corner.flat = -corner.flat;
    if (corner.normal.dot(corner.flat) < 0) corner.normal = -corner.normal;
    return corner;
  }

  Sample SampleOf(const Ray& ray, const Hit& hit, const Corner& corner, const Vec3f& view, bool lit) const {
    const StageSet::Thing& thing = things_[hit.instance];
    const Eigen::Matrix3f& axes = axes_[hit.instance];
    const float distance = hit.distance * ray.direction.norm();
    Spot spot;
    spot.at = axes.transpose() * (corner.at - origins_[hit.instance]);
    spot.normal = axes.transpose() * corner.normal;
    spot.part = MeshOf(hit).parts[hit.triangle];
    spot.footprint = pixel_angle_ * distance / std::sqrt(std::max(-corner.flat.dot(view), 0.02f));
    const Surface surface = set_.SurfaceOf(thing, spot);
    Vec3f normal = corner.normal;
    if (surface.thin && normal.dot(light_.to_sun) < 0) normal = -0.6f * normal;
    const float open = thing.kind == StageSet::Kind::kGround ? shade_.OpenSky(corner.at) : 1;
    Sample sample;
    sample.colour = ThroughAir(light_, Shade(light_, surface, normal, view, lit ? 1 : 0, open), distance);
    sample.depth = hit.distance;
    sample.identity = thing.identity;
    const bool leaves = surface.thin;  // too many edges to smooth them all
    sample.key = static_cast<std::uint32_t>(hit.instance + 1) << 16 |
                 (leaves ? 0u : static_cast<std::uint32_t>(surface.kind) << 1 | static_cast<std::uint32_t>(lit));
    if (thing.kind == StageSet::Kind::kTown) sample.key += static_cast<std::uint32_t>(spot.part) << 5;
    return sample;
  }

  const StageSet& set_;
  const Daylight& light_;
  std::vector<StageSet::Thing> things_;
  ContactShade shade_;
  Scene scene_;
  float pixel_angle_;
  std::vector<Eigen::Matrix3f> axes_;  ///< of the things' meshes in the scene
  std::vector<Vec3f> origins_;
};

/// Rays of one image. Their directions are 1 long along the optical axis, so a hit's distance is its depth.
class Eye {
 public:
  Eye(const Camera& camera, const Pose& T_scene_camera)
      : camera_(camera),
        axes_(T_scene_camera.so3().matrix().cast<float>()),
        origin_(T_scene_camera.translation().cast<float>()) {}
  Ray At(float x, float y) const {
    const Vec3f way((x - static_cast<float>(camera_.cx)) / static_cast<float>(camera_.fx),
                    (y - static_cast<float>(camera_.cy)) / static_cast<float>(camera_.fy), 1);
    return {origin_, axes_ * way, kFar};
  }

 private:
  const Camera& camera_;
  Eigen::Matrix3f axes_;
  Vec3f origin_;
};

struct Pixel {
  int x = 0, y = 0;
};

/// All pixels, neighbours close together: tiles of 4 x 2 in bands.
std::vector<Pixel> InTiles(int width, int height) {
  std::vector<Pixel> pixels;
  pixels.reserve(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; y += 2) {
    for (int x = 0; x < width; x += 4) {
      for (int dy = 0; dy < std::min(2, height - y); ++dy) {
        for (int dx = 0; dx < std::min(4, width - x); ++dx) pixels.push_back({x + dx, y + dy});
      }
    }
  }
  return pixels;
}

}  // namespace

struct Renderer::Impl {
  StageSet set;
  RayTracer tracer;
  Daylight light[2];
  int return_frame;
  std::uint32_t seed;
  RenderOptions options;
};

Renderer::Renderer(const sim::HalvWorld& scene, std::uint64_t seed, const RenderOptions& options) {
  sim::CheckFields(options);
  if (scene.world.truth.poses.empty() || scene.world.camera.width <= 0 || scene.world.camera.height <= 0)
    throw Error(ErrorKind::kUsage, "nothing to render: a world needs frames and a camera with an image size");
  const std::uint32_t own = Hash(static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32));
  StageSet set(scene, own);
  RayTracer tracer(set.meshes());
  impl_.reset(new Impl{std::move(set),
                       std::move(tracer),
                       {MakeDaylight(options.out, Hash(own, 1)), MakeDaylight(options.back, Hash(own, 2))},
                       scene.return_frame,
                       own,
                       options});
}

Renderer::~Renderer() = default;

int Renderer::frames() const { return static_cast<int>(impl_->set.world().truth.size()); }

View Renderer::Render(int frame, Side side) const {
  const sim::World& world = impl_->set.world();
  if (frame < 0 || frame >= frames()) throw Error(ErrorKind::kUsage, "there is no frame " + std::to_string(frame));
  const Daylight& light = impl_->light[frame < impl_->return_frame ? 0 : 1];
  const Camera& camera = world.camera;
  const Vec3 right(side == Side::kRight ? world.baseline_m : 0, 0, 0);
  const Pose T_scene_camera =
      impl_->set.T_scene_world() * world.truth.poses[frame] * Pose(lie::SO3<double>(), right - camera.offset);
  const Eye eye(camera, T_scene_camera);
  const Moment moment(impl_->set, impl_->tracer, light, frame, static_cast<float>(1 / camera.fx));

  View view;
  view.width = camera.width;
  view.height = camera.height;
  const std::vector<Pixel> pixels = InTiles(view.width, view.height);
  std::vector<Vec3f> colours(pixels.size());
  std::vector<std::uint32_t> keys(pixels.size());
  view.depth.resize(pixels.size());
  view.identity.resize(pixels.size());
  constexpr std::size_t kBatch = 4096;
  for (std::size_t first = 0; first < pixels.size(); first += kBatch) {
    const std::size_t end = std::min(first + kBatch, pixels.size());
    std::vector<Ray> rays;
    for (std::size_t i = first; i < end; ++i)
      rays.push_back(eye.At(static_cast<float>(pixels[i].x), static_cast<float>(pixels[i].y)));
    const std::vector<Sample> samples = moment.Look(rays);
    for (std::size_t i = first; i < end; ++i) {
      const std::size_t at = view.PixelAt(pixels[i].x, pixels[i].y);
      const Sample& sample = samples[i - first];
      colours[at] = sample.colour;
      keys[at] = sample.key;
      view.depth[at] = sample.depth;
      view.identity[at] = sample.identity;
    }
  }
  if (impl_->options.smooth_edges) {
    std::vector<Pixel> edges;
    for (const Pixel& pixel : pixels) {
      const std::uint32_t key = keys[view.PixelAt(pixel.x, pixel.y)];
      const auto differs = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < view.width && y < view.height && keys[view.PixelAt(x, y)] != key;
      };
      if (differs(pixel.x - 1, pixel.y) || differs(pixel.x + 1, pixel.y) || differs(pixel.x, pixel.y - 1) ||
          differs(pixel.x, pixel.y + 1))
        edges.push_back(pixel);
    }
    // With the ray through the centre: four places, none in line with another.
    constexpr float kPlaces[3][2] = {{-0.375f, -0.125f}, {0.125f, -0.375f}, {0.25f, 0.375f}};
    for (std::size_t first = 0; first < edges.size(); first += kBatch) {
      const std::size_t end = std::min(first + kBatch, edges.size());
      std::vector<Ray> rays;
      for (std::size_t i = first; i < end; ++i) {
        for (const auto& [dx, dy] : kPlaces)
          rays.push_back(eye.At(static_cast<float>(edges[i].x) + dx, static_cast<float>(edges[i].y) + dy));
      }
      const std::vector<Sample> samples = moment.Look(rays);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const Pixel& pixel = edges[first + i / 3];
        Vec3f& colour = colours[view.PixelAt(pixel.x, pixel.y)];
        if (i % 3 == 0) colour *= 0.25f;
        colour += 0.25f * samples[i].colour.cwiseMin(4.f);
      }
    }
  }
  const std::uint32_t image = 2 * static_cast<std::uint32_t>(frame) + (side == Side::kRight);
  view.bgr = Develop(colours, view.width, view.height, light.exposure, impl_->options, Hash(impl_->seed, image));
  return view;
}

}  // namespace sslcd::render
