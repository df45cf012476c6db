// SPDX-License-Identifier: BSD-3-Clause
// Replaces ray_tracer_embree.cc if Embree is not installed.
#include "render/ray_tracer.h"
#include "sslcd/core/error.h"

namespace sslcd::render {
namespace {

[[noreturn]] void Refuse() {
  throw Error(ErrorKind::kUsage,
              "this build cannot render: Embree was not found; install libembree-dev "
              "(scripts/install_deps.sh test "
              "does), configure and build anew");
}

}  // namespace

struct Scene::Impl {};
Scene::Scene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene::~Scene() = default;
void Scene::Trace(const std::vector<Ray>&, std::vector<Hit>&) const { Refuse(); }
void Scene::Hidden(const std::vector<Ray>&, std::vector<char>&) const { Refuse(); }

struct RayTracer::Impl {};
RayTracer::RayTracer(const std::vector<Mesh>&) { Refuse(); }
RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer::~RayTracer() = default;
Scene RayTracer::MakeScene(const std::vector<Instance>&) const { Refuse(); }

}  // namespace sslcd::render
