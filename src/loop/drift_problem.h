// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loop/drift.h"

/// What SolveDrift works on: the pairs in gravity-aligned axes (z up), and where to start.
namespace sslcd::drift {

using Mat3 = Eigen::Matrix3d;
using Rotation = lie::SO3<double>;

struct Match {
  Vec3 local, global;  ///< centres [m]
  double yaw_local = 0, yaw_global = 0;
  double period = 0;  ///< of the yaw; 0: no yaw
  Vec3 sigma;         ///< of the position, per axis [m]
  double sigma_yaw = 1;

  double weight() const { return 1 / (sigma.x() * sigma.x()); }
};

/// D as p_global = R (p_local - centre) + t: turned about the middle of the objects, not about a
/// far-away origin.
struct State {
  Rotation R;
  Vec3 t;
};

struct Problem {
  std::vector<Match> matches;
  Vec3 centre;
  double loss_scale = 0;
};

/// What is wrong with the input; empty: nothing.
std::string Check(const std::vector<DriftPair>& pairs);

Problem MakeProblem(const std::vector<DriftPair>& pairs, const GravityFrame& gravity,
                    double loss_scale);

/// Rows: the axes of an object with this yaw.
Mat3 UprightInverse(double yaw);

/// Translation of E = T_wo_g^-1 D T_wo_l. [m]
Vec3 PositionError(const Match& match, const Problem& problem, const State& state);

/// Where the local object faces after D; unit length.
Vec3 Heading(const Match& match, const State& state);

/// Yaw of E, modulo the object's symmetry; for objects with a yaw only. [rad]
double YawError(const Match& match, const State& state);

struct Start {
  State state;
  bool by_positions = false;  ///< the positions fix the yaw, whatever the headings say
};

/// The best of the Procrustes solution and every pair's own yaw difference; or none, and the
/// reason.
std::optional<Start> FindStart(const Problem& problem, double max_yaw_sigma_rad,
                               std::string& reason);

}  // namespace sslcd::drift
