// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "loop/drift.h"
#include "sslcd/core/pose.h"

namespace sslcd {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline const Vec3 kKittiUp(0, -1, 0);

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double Uniform(double low, double high) {
    return low + (high - low) * ((engine_() + 0.5) / 4294967296.);
  }
  double Normal(double sigma) {
    return sigma * std::sqrt(-2 * std::log(Uniform(0, 1))) * std::cos(Uniform(0, 2 * M_PI));
  }

 private:
  std::mt19937 engine_;
};

/// Objects on a street seen twice, the second time displaced by D^-1.
struct Scene {
  Vec3 up = kKittiUp;
  Vec3 middle{0, 0, 0};  // of the street, in the world
  Pose D;                // T_global_local
  int objects = 12;
  double position_noise_m = 0, yaw_noise_rad = 0;
  double flipped = 0;  // share of the local yaws that are off by half a turn
  Symmetry symmetry = Symmetry::kNone;

  GravityFrame gravity() const { return GravityFrame::FromUp(up); }

  std::vector<DriftPair> Pairs(Random& random) const {
    const GravityFrame axes = gravity();
    std::vector<DriftPair> pairs;
    for (int i = 0; i < objects; ++i) {
      const Vec3 in_street(random.Uniform(-25, 25), random.Uniform(-10, 10),
                           random.Uniform(-0.5, 0.5));
      const UprightPose truth{middle + axes.Basis() * in_street, random.Uniform(-M_PI, M_PI)};
      const auto seen = [&](double turn) {
        const Vec3 error(random.Normal(1), random.Normal(1), random.Normal(1));
        return ToPose({truth.position + position_noise_m * error,
                       truth.yaw + turn + random.Normal(yaw_noise_rad)},
                      axes);
      };
      DriftPair pair;
      pair.T_world_global = seen(0);
      pair.T_world_local = D.inverse() * seen(i < flipped * objects ? M_PI : 0.);
      pair.symmetry = symmetry;
      pair.sigma_horizontal_m = pair.sigma_vertical_m =
          std::sqrt(2.) * std::max(position_noise_m, 0.01);
      pair.sigma_yaw_rad = std::sqrt(2.) * std::max(yaw_noise_rad, 0.01);
      pairs.push_back(pair);
    }
    return pairs;
  }
};

/// Yaw and shift only; the vertical of the local map is known to .01 rad.
inline DriftOptions FourDof() {
  DriftOptions options;
  options.six_dof = false;
  options.tilt_sigma_rad = 0.01;
  return options;
}

/// A drift that turns about `centre`.
inline Pose TurnAndShift(const Vec3& up, double yaw, const Vec3& centre, const Vec3& shift) {
  const Pose turn(lie::SO3<double>::Exp(yaw * up), Vec3(Vec3::Zero()));
  return Pose::Trans(centre + shift) * turn * Pose::Trans(-centre);
}

inline double Difference(const Pose& a, const Pose& b) { return (a.inverse() * b).Log().norm(); }

inline DriftPair At(const Vec3& local, const Vec3& global, double yaw_local, double yaw_global,
                    Symmetry symmetry) {
  LayoutObject from, to;
  from.position = local;
  to.position = global;
  from.yaw = yaw_local;
  to.yaw = yaw_global;
  from.symmetry = to.symmetry = symmetry;
  return MakeDriftPair(from, to);
}

inline DriftResult Solve(const std::vector<DriftPair>& pairs) {
  return SolveDrift(pairs, GravityFrame::FromUp(Vec3::UnitZ()), FourDof());
}

}  // namespace sslcd
