// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "association/gallery.h"
#include "sslcd/association/options.h"
#include "sslcd/core/cue.h"
#include "sslcd/core/detection.h"

namespace sslcd {

/// A Gaussian position in the horizontal plane of the world. [m, m^2]
struct PlanarGaussian {
  Vec2 position{0, 0};
  Eigen::Matrix<double, 2, 2, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 2, 2, Eigen::DontAlign>::Zero();
};

/// A detection d_i in data association.
struct AssociationQuery {
  const Detection* detection = nullptr;
  PlanarGaussian place;
  double height = 0;         ///< height of the centre above the world's origin [m]
  double viewpoint_rad = 0;  ///< bearing of the camera in the object frame
};

/// A landmark o_k in data association with this frame.
struct AssociationCandidate {
  std::string label;
  /// possible positions, most plausible first (parked, driving); at least one
  std::vector<PlanarGaussian> predictions;
  double height = 0;
  double viewpoint_rad = 0;
  std::optional<Box2d> projected_box;           ///< Eq. 1
  const PerCue<Gallery>* appearance = nullptr;  ///< null: unknown
};

/// W_d of Eq. 2 (queries x candidates); 0: must not match.
Eigen::MatrixXd AssociationMatrix(const std::vector<AssociationQuery>& queries,
                                  const std::vector<AssociationCandidate>& candidates,
                                  const AssociationOptions& options);

/// Returns the index of the candidate of each query, -1 for none. Maximises the total score of a
/// one-to-one assignment.
std::vector<int> Associate(const std::vector<AssociationQuery>& queries,
                           const std::vector<AssociationCandidate>& candidates,
                           const AssociationOptions& options);

}  // namespace sslcd
