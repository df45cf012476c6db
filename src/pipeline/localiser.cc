// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/localiser.h"

#include <utility>

#include "closing/reference_finder.h"
#include "pipeline/canonical_input.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

const ReferenceMap& Checked(const ReferenceMap& map) {
  CheckReferenceMap(map);
  return map;
}

Options WithSearch(Options options) {
  options.loop.enabled = true;
  return options;
}

}  // namespace

struct SSLCD_HIDDEN Localiser::Impl {
  Impl(const ReferenceMap& map, const Options& options, const std::optional<Camera>& camera)
      : scale(map.scale),
        R_map_start(
            lie::SO3<double>::FromMatrix(map.gravity.Basis() * GravityFrame().Basis().transpose())),
        mapper(WithSearch(options), {map.gravity, map.labels, camera},
               MakeReferenceFinder(options.loop, map,
                                   [this](const Localisation& found) { answer = found; })) {}

  // The finder reports to it.
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // The finder answers in the axes of the mapper's world, and for odometry in that world.
  Localisation Take() {
    Localisation taken = *std::exchange(answer, std::nullopt);
    const Pose T_map_start(R_map_start, Vec3::Zero());
    if (!taken.pairs.empty()) {  // poses are set
      taken.T_map_cam = T_map_start * taken.T_map_cam;
      taken.T_map_odom = T_map_start * taken.T_map_odom * T_start_odom;
    }
    return taken;
  }

  double scale;
  lie::SO3<double> R_map_start;        // turns the mapper's axes to those of the map
  Pose T_start_odom;                   // to the mapper's world
  Mapper mapper;                       // gets metric odometry
  std::optional<Localisation> answer;  // of the newest attempt
  bool started = false;
};

Localiser::Localiser(const ReferenceMap& map, const Options& options,
                     const std::optional<Camera>& camera)
    : impl_(std::make_unique<Impl>(Checked(map), options, camera)) {}
Localiser::~Localiser() = default;
Localiser::Localiser(Localiser&&) noexcept = default;
Localiser& Localiser::operator=(Localiser&&) noexcept = default;

std::optional<Localisation> Localiser::AddFrame(const Frame& frame) {
  Frame metric = frame;
  metric.T_odom_cam =
      Pose(frame.T_odom_cam.so3(), Vec3(impl_->scale * frame.T_odom_cam.translation()));
  if (!impl_->started) impl_->T_start_odom = StartOf(metric.T_odom_cam, impl_->mapper.gravity());
  impl_->mapper.AddFrame(metric);
  impl_->started = true;
  if (!impl_->answer) return std::nullopt;
  return impl_->Take();
}

Localisation Localiser::Attempt() {
  if (!impl_->started) throw Error(ErrorKind::kUsage, "there is no frame to localise yet");
  impl_->mapper.SearchNow();
  return impl_->Take();
}

}  // namespace sslcd
