// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loop/drift.h"

/// The problem of SolveDrift: the pairs in gravity-aligned axes (z up) and the initial values.
namespace sslcd::drift {

using Mat3 = Eigen::Matrix3d;
using Rotation = lie::SO3<double>;

struct Match {
  Vec3 local, global;  ///< centres [m]
  double yaw_local = 0, yaw_global = 0;
  double period = 0;  ///< period of the yaw; 0: no yaw
  Vec3 sigma;         ///< standard deviation of the position per axis [m]
  double sigma_yaw = 1;
  Mat3 to_global;  ///< rotation to the axes of the global object

  bool has_yaw() const { return period > 0; }
  double weight() const { return 1 / (sigma.x() * sigma.x()); }
};

/// D as p_global = R (p_local - centre) + t: a rotation about the centre of the objects instead of
/// a distant origin.
struct State {
  Rotation R;
  Vec3 t = Vec3::Zero();
};

struct Problem {
  std::vector<Match> matches;
  Vec3 centre;
  double loss_scale = 0;
};

/// The problem of the input; empty: the input is valid.
std::string Check(const std::vector<DriftPair>& pairs);

Problem MakeProblem(const std::vector<DriftPair>& pairs, const GravityFrame& gravity,
                    double loss_scale);

/// Translation of E = T_wo_g^-1 D T_wo_l. [m]
Vec3 PositionError(const Match& match, const Problem& problem, const State& state);

/// Heading of the local object after D as a unit vector.
Vec3 Heading(const Match& match, const State& state);

/// Yaw of E modulo the object's symmetry, for objects with a yaw. [rad]
double YawError(const Match& match, const State& state);

struct Start {
  State state;
  bool by_positions = false;  ///< the positions determine the yaw without headings
};

/// The best of the Procrustes solution and the yaw difference of each pair; or none with a reason.
std::optional<Start> FindStart(const Problem& problem, double max_yaw_sigma_rad,
                               std::string& reason);

}  // namespace sslcd::drift
