// SPDX-License-Identifier: BSD-3-Clause
#include "render/renderer.h"

#include <string>

#include "render/frame_shader.h"
#include "render/noise.h"
#include "render/sensor.h"
#include "sim/check_fields.h"
#include "sslcd/core/error.h"

namespace sslcd::render {
namespace {

constexpr std::size_t kBatch = 1024;  // rays at once

struct Pixel {
  int x = 0, y = 0;
};

/// Rays of one image. Their directions have length 1 along the optical axis, so the distance of a
/// hit is its depth.
class PixelRays {
 public:
  PixelRays(const Camera& camera, const Pose& T_scene_camera)
      : camera_(camera),
        axes_(T_scene_camera.so3().matrix().cast<float>()),
        origin_(T_scene_camera.translation().cast<float>()) {}

  /// The ray at the offset `off` from a pixel's centre.
  Ray Through(const Pixel& pixel, const Vec2f& off) const {
    const Vec3 way((static_cast<double>(pixel.x) + off.x() - camera_.cx) / camera_.fx,
                   (static_cast<double>(pixel.y) + off.y() - camera_.cy) / camera_.fy, 1);
    return {origin_, axes_ * way.cast<float>(), FrameShader::kFar};
  }

 private:
  const Camera& camera_;
  Eigen::Matrix3f axes_;
  Vec3f origin_;
};

/// All pixels in an order that keeps neighbours together: tiles of 4 x 2 in bands.
std::vector<Pixel> PixelsInTiles(int width, int height) {
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

/// The pixels next to another surface or shadow.
std::vector<Pixel> FindEdges(const std::vector<Pixel>& pixels, const std::vector<Sample>& samples,
                             const Camera& camera) {
  std::vector<Pixel> edges;
  for (const auto& [x, y] : pixels) {
    const Sample* own = &samples[y * camera.width + x];
    if ((x > 0 && own[-1].key != own->key) || (x + 1 < camera.width && own[1].key != own->key) ||
        (y > 0 && own[-camera.width].key != own->key) ||
        (y + 1 < camera.height && own[camera.width].key != own->key))
      edges.push_back({x, y});
  }
  return edges;
}

/// Takes the mean of four rays instead of one. Keeps depth and identity of the pixel's centre.
void SmoothEdges(const FrameShader& shader, const PixelRays& pixel_rays, int width,
                 const std::vector<Pixel>& edges, std::vector<Sample>& samples) {
  // offsets that are not in line with each other and the centre
  const Vec2f kPlaces[] = {{-0.375f, -0.125f}, {0.125f, -0.375f}, {0.25f, 0.375f}};
  // otherwise the sun and its reflections would dominate the mean
  constexpr float kBrightest = 4;
  for (std::size_t first = 0; first < edges.size(); first += kBatch) {
    std::vector<Ray> rays;
    for (std::size_t i = first; i < std::min(first + kBatch, edges.size()); ++i) {
      for (const Vec2f& place : kPlaces) rays.push_back(pixel_rays.Through(edges[i], place));
    }
    const std::vector<Sample> others = shader.TraceRays(rays);
    for (std::size_t i = 0; i < others.size(); ++i) {
      const Pixel& pixel = edges[first + i / 3];
      Vec3f& colour = samples[pixel.y * width + pixel.x].colour;
      if (i % 3 == 0) colour *= 0.25f;
      colour += 0.25f * others[i].colour.cwiseMin(kBrightest);
    }
  }
}

}  // namespace

struct Renderer::Impl {
  SceneModel model;
  RayTracer tracer;
  Daylight light[2];
  int return_frame;
  std::uint32_t seed;
  RenderOptions options;
};

Renderer::Renderer(const sim::HalvWorld& scene, std::uint64_t seed, const RenderOptions& options) {
  sim::CheckFields(options);
  if (scene.world.truth.poses.empty() || scene.world.camera.width <= 0 ||
      scene.world.camera.height <= 0)
    throw Error(ErrorKind::kUsage,
                "nothing to render: a world needs frames and a camera with an image size");
  const std::uint32_t own =
      Hash(static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32));
  SceneModel model(scene, own);
  RayTracer tracer(model.meshes());
  impl_.reset(
      new Impl{std::move(model),
               std::move(tracer),
               {MakeDaylight(options.out, Hash(own, 1)), MakeDaylight(options.back, Hash(own, 2))},
               scene.return_frame,
               own,
               options});
}

Renderer::~Renderer() = default;

int Renderer::frames() const { return static_cast<int>(impl_->model.world().truth.size()); }

int Renderer::objects() const { return static_cast<int>(impl_->model.world().objects.size()); }

View Renderer::Render(int frame, Side side) const {
  const sim::World& world = impl_->model.world();
  if (frame < 0 || frame >= frames())
    throw Error(ErrorKind::kUsage, "there is no frame " + std::to_string(frame));
  const Daylight& light = impl_->light[frame < impl_->return_frame ? 0 : 1];
  const Camera& camera = world.camera;
  const Vec3 right(side == Side::kRight ? world.baseline_m : 0, 0, 0);
  const Pose T_scene_camera = impl_->model.T_scene_world() * world.truth.poses[frame] *
                              Pose(lie::SO3<double>(), right - camera.offset);
  const PixelRays pixel_rays(camera, T_scene_camera);
  const FrameShader shader(impl_->model, impl_->tracer, light, frame,
                           static_cast<float>(1 / camera.fx));

  const std::vector<Pixel> pixels = PixelsInTiles(camera.width, camera.height);
  std::vector<Sample> samples(pixels.size());  // row by row
  for (std::size_t first = 0; first < pixels.size(); first += kBatch) {
    std::vector<Ray> rays;
    for (std::size_t i = first; i < std::min(first + kBatch, pixels.size()); ++i)
      rays.push_back(pixel_rays.Through(pixels[i], {0, 0}));
    const std::vector<Sample> batch = shader.TraceRays(rays);
    for (std::size_t i = 0; i < batch.size(); ++i)
      samples[pixels[first + i].y * camera.width + pixels[first + i].x] = batch[i];
  }
  if (impl_->options.smooth_edges)
    SmoothEdges(shader, pixel_rays, camera.width, FindEdges(pixels, samples, camera), samples);

  View view{camera.width, camera.height, {}, {}, {}};
  for (const Sample& sample : samples) {
    view.depth.push_back(sample.depth);
    view.identity.push_back(sample.identity);
  }
  const std::uint32_t image = 2 * static_cast<std::uint32_t>(frame) + (side == Side::kRight);
  view.bgr = Develop(samples, view.width, view.height, light.exposure, impl_->options,
                     Hash(impl_->seed, image));
  return view;
}

}  // namespace sslcd::render
