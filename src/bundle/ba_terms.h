// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/sphere_manifold.h>

#include <array>
#include <vector>

#include "bundle/object_ba.h"
#include "pose_graph/pose_manifold.h"

namespace sslcd {

/// A BaProblem's states as Ceres parameter blocks, and its residuals as Ceres residual blocks.
class BaTerms {
 public:
  BaTerms(const BaProblem& problem, const BaOptions& options);

  ceres::Problem& ceres() { return ceres_; }
  /// The states that are not constant: cameras, objects, and the others.
  std::vector<double*> States();
  double* camera(int i) { return cameras_[i].data(); }
  double* object(int k) { return objects_[k].data(); }
  double* log_scale() { return &log_scale_; }

  /// Copies the states back.
  void Store(BaProblem& problem) const;

 private:
  void AddSightings(const BaProblem& problem, const BaOptions& options);
  void AddOdometry(const BaProblem& problem, const BaOptions& options);
  void AddTies(const BaProblem& problem);
  void AddSlopes(const BaProblem& problem);
  void AddPriors(const BaProblem& problem, const BaOptions& options);

  PoseManifold pose_manifold_;
  ceres::SubsetManifold without_yaw_{4, {3}};
  ceres::SphereManifold<3> direction_manifold_;
  ceres::CauchyLoss loss_, tie_loss_, scale_loss_;
  ceres::Problem ceres_;  // refers to the members above
  std::vector<std::array<double, 7>> cameras_;
  std::vector<std::array<double, 4>> objects_;
  double log_scale_ = 0;
  std::array<double, 3>
      up_{};  // unit vector against gravity in the world, if there is a slope prior
};

}  // namespace sslcd
