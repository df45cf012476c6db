// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_prior.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace sslcd {
namespace {

// Standard deviations of the drift at path length 0. Set by hand. [m, rad]
constexpr double kStartMetres = 1., kStartRad = 0.02;
// At a sigma of sqrt(2 pi) = 2.5 the peak density of a Gaussian equals the uniform density 1 / (2
// pi), so the sigma is limited to it. [rad]
constexpr double kWidestYaw = 2.5;

}  // namespace

PoseTracks::Prior OdometryPrior(const PassMap& passes, const PathGraph::Distances& distances,
                                const PassLayout& local, const LayoutIndex& index,
                                const LoopPriorOptions& options) {
  const double searched = index.pose_volume();
  return [=, &passes, &local, &index](const YawShift& pose, const LayoutFit& fit) {
    if (fit.matches.empty()) return 0.;
    std::vector<double> paths;
    Vec3 centre = Vec3::Zero();
    for (const auto& [i, j] : fit.matches) {
      const int first_pass = passes.PassesOf({index.objects()[j].id}).front();
      paths.push_back(distances.To(passes.passes()[first_pass].last_m));
      centre += local.objects[i].position / static_cast<double>(fit.matches.size());
    }
    const double path = Median(std::move(paths));
    const double sigma_yaw = std::hypot(kStartRad, options.drift_yaw * std::sqrt(path));
    const double sigma =
        std::hypot(kStartMetres, options.drift_share * path, sigma_yaw * path / std::sqrt(3.));
    const double moved = (Apply(pose, centre) - centre).head<2>().norm() / sigma;
    const double turned = WrapAngle(pose.yaw) / sigma_yaw;
    const double density =
        std::exp(-0.5 * (moved * moved + turned * turned)) /
        (std::pow(2 * M_PI, 1.5) * sigma * sigma * std::min(sigma_yaw, kWidestYaw));
    return std::log(options.surprise + (1 - options.surprise) * searched * density);
  };
}

}  // namespace sslcd
