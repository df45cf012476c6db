// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/ba_terms.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <cmath>

#include "bundle/ba_costs.h"
#include "bundle/cost_functors.h"
#include "bundle/marginal_prior.h"
#include "pose_graph/cost.h"

namespace sslcd {
namespace {

template <class Functor, int kResiduals, int... kBlocks>
ceres::CostFunction* AutoDiff(const Functor& functor) {
  return new ceres::AutoDiffCostFunction<Functor, kResiduals, kBlocks...>(new Functor(functor));
}

// A tie with an error of this many standard deviations has half the weight. Set by hand.
constexpr double kTieLoss = 3;
// The same for the scale, so that a wrong unit of the odometry is found.
constexpr double kScaleLoss = 4;
// Standard deviations that fix the first camera; with a prior of the cameras they are larger by
// this factor. Set by hand. [m, rad]
constexpr double kGaugeMetres = 1e-3, kGaugeRad = 1e-4, kLooserGauge = 300;
constexpr double kFullWeight = 1;

// The problem does not own shared functions, which exist once.
ceres::Problem::Options Shared() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

}  // namespace

BaTerms::BaTerms(const BaProblem& problem, const BaOptions& options)
    : loss_(options.loss_scale > 0 ? options.loss_scale : 1.),
      tie_loss_(kTieLoss),
      scale_loss_(kScaleLoss),
      ceres_(Shared()),
      cameras_(problem.cameras.size()),
      objects_(problem.objects.size()),
      log_scale_(problem.log_scale) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    std::copy_n(problem.cameras[i].T_world_cam.data(), 7, cameras_[i].data());
    ceres_.AddParameterBlock(cameras_[i].data(), 7, &pose_manifold_);
  }
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    const UprightPose& pose = problem.objects[k].pose;
    objects_[k] = {pose.position.x(), pose.position.y(), pose.position.z(), pose.yaw};
    // The yaw of a symmetric object is constant; no residual measures it.
    if (problem.objects[k].symmetry == Symmetry::kFull)
      ceres_.AddParameterBlock(objects_[k].data(), 4, &without_yaw_);
    else
      ceres_.AddParameterBlock(objects_[k].data(), 4);
  }
  ceres_.AddParameterBlock(&log_scale_, 1);
  AddSightings(problem, options);
  AddOdometry(problem, options);
  AddTies(problem);
  AddSlopes(problem);
  AddPriors(problem, options);
}

void BaTerms::AddSightings(const BaProblem& problem, const BaOptions& options) {
  for (const BaSighting& sighting : problem.sightings) {
    double* camera = cameras_[sighting.camera].data();
    double* object = objects_[sighting.object].data();
    if (options.residual == BaOptions::Residual::kPaper) {
      const PaperObjectResidual residual{sighting.T_cam_object, problem.gravity};
      ceres_.AddResidualBlock(AutoDiff<PaperObjectResidual, 6, 7, 4>(residual), nullptr, camera,
                              object);
      continue;
    }
    // Takes ray and sigmas at the estimated place. With the measured range, detections that are too
    // near would have more weight than those that are too far, and the map would shrink.
    const Pose& T_world_cam = problem.cameras[sighting.camera].T_world_cam;
    const Vec3 expected = T_world_cam.inverse() * problem.objects[sighting.object].pose.position;
    DetectionSigmas sigmas = SigmasAt(expected.norm(), problem.noise, problem.noise_scale);
    sigmas.radial *= options.correlation;
    sigmas.lateral *= options.correlation;
    sigmas.vertical *= options.correlation;
    sigmas.yaw *= options.correlation;
    // Detectors sometimes confuse front and back, so even a car's heading counts only modulo half a
    // turn.
    const double period = problem.objects[sighting.object].symmetry == Symmetry::kFull ? 0. : M_PI;
    const ObjectResidual residual{sighting.T_cam_object, expected, sigmas, period, problem.gravity};
    ceres_.AddResidualBlock(new ObjectCost(residual), options.loss_scale > 0 ? &loss_ : nullptr,
                            camera, object);
  }
}

void BaTerms::AddOdometry(const BaProblem& problem, const BaOptions& options) {
  for (const BaOdometry& edge : problem.odometry) {
    const OdometrySigmas sigmas = SigmasOf(edge.T_from_to, options.odometry, edge.failures);
    const Vec3 up = problem.cameras[edge.to].T_world_cam.so3().inverse() * problem.gravity.up;
    const OdometryResidual residual{edge.T_from_to,
                                    WhiteningOf(sigmas, problem.odometry_factors, up)};
    ceres_.AddResidualBlock(new OdometryCost(residual), nullptr, cameras_[edge.from].data(),
                            cameras_[edge.to].data(), &log_scale_);
  }
}

void BaTerms::AddTies(const BaProblem& problem) {
  for (const BaTie& tie : problem.ties) {
    if (tie.from == tie.to) continue;
    PoseGraph::Edge edge;
    edge.T_from_to = tie.pose.T_a_b;
    edge.information = tie.pose.covariance.inverse();
    ceres_.AddResidualBlock(new EdgeCost(edge, &kFullWeight), &tie_loss_, cameras_[tie.from].data(),
                            cameras_[tie.to].data());
  }
}

void BaTerms::AddSlopes(const BaProblem& problem) {
  if (problem.slope.sigma_rad <= 0 || problem.cameras.empty()) return;
  const Vec3 up_in_cam = problem.cameras.front().T_world_cam.so3().inverse() * problem.gravity.up;
  std::copy_n(problem.gravity.up.data(), 3, up_.data());
  ceres_.AddParameterBlock(up_.data(), 3, &direction_manifold_);
  const DirectionPrior first_slope{problem.gravity.up, problem.slope.sigma_rad};
  ceres_.AddResidualBlock(AutoDiff<DirectionPrior, 3, 3>(first_slope), nullptr, up_.data());
  for (const BaOdometry& edge : problem.odometry) {
    const double path = std::exp(problem.log_scale) * edge.T_from_to.translation().norm();  // [m]
    if (path <= 0) continue;
    // Cameras on the same slope share its prior.
    const double sigma =
        problem.slope.sigma_rad * std::sqrt(std::max(1., problem.slope.length_m / path));
    const SlopeResidual residual{up_in_cam, sigma};
    ceres_.AddResidualBlock(AutoDiff<SlopeResidual, 3, 7, 3>(residual), nullptr,
                            cameras_[edge.to].data(), up_.data());
  }
}

void BaTerms::AddPriors(const BaProblem& problem, const BaOptions& options) {
  if (!problem.prior.empty()) {
    std::vector<double*> blocks;
    const auto find = [](const auto& list, int name, auto member) {
      for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].*member == name) return static_cast<int>(i);
      return -1;
    };
    for (const int frame : problem.prior.frames)
      blocks.push_back(cameras_[find(problem.cameras, frame, &BaCamera::frame)].data());
    for (const int id : problem.prior.object_ids)
      blocks.push_back(objects_[find(problem.objects, id, &BaObject::id)].data());
    blocks.push_back(&log_scale_);
    ceres_.AddResidualBlock(new MarginalPriorCost(problem.prior), nullptr, blocks);
  } else if (options.odometry.scale_prior > 0) {
    const ScalarPrior scale{problem.expected_log_scale, options.odometry.scale_prior};
    ceres_.AddResidualBlock(AutoDiff<ScalarPrior, 1, 1>(scale), &scale_loss_, &log_scale_);
  }
  if (!cameras_.empty() && (problem.prior.empty() || problem.hold_first)) {
    // The gauge: the first camera defines the world; with a prior only weakly.
    const double looser = problem.prior.empty() ? 1 : kLooserGauge;
    const PosePrior gauge{problem.cameras.front().T_world_cam, kGaugeMetres * looser,
                          kGaugeRad * looser};
    ceres_.AddResidualBlock(AutoDiff<PosePrior, 6, 7>(gauge), nullptr, cameras_.front().data());
  }
  if (options.odometry.scale_prior <= 0) ceres_.SetParameterBlockConstant(&log_scale_);
}

std::vector<double*> BaTerms::States() {
  std::vector<double*> states;
  for (auto& camera : cameras_) states.push_back(camera.data());
  for (auto& object : objects_) states.push_back(object.data());
  for (double* other : {&log_scale_, up_.data()})
    if (ceres_.HasParameterBlock(other) && !ceres_.IsParameterBlockConstant(other))
      states.push_back(other);
  return states;
}

void BaTerms::Store(BaProblem& problem) const {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    std::copy_n(cameras_[i].data(), 7, problem.cameras[i].T_world_cam.data());
    problem.cameras[i].T_world_cam.normalise();
  }
  for (std::size_t k = 0; k < objects_.size(); ++k)
    problem.objects[k].pose = {Vec3(objects_[k][0], objects_[k][1], objects_[k][2]),
                               WrapAngle(objects_[k][3])};
  problem.log_scale = log_scale_;
}

}  // namespace sslcd
