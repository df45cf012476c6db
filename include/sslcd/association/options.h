// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"

namespace SSLCD_EXPORT sslcd {

/// Data association, paper III-B.
struct AssociationOptions {
  enum class Method {
    kRobust,  ///< gate by 3D distance, geometry joins the score, one-to-one by maximum total score
    kPaper,   ///< Eqs. 2-6 as printed: label gate and appearance score only
  };
  Method method = Method::kRobust;
  double lambda = 0.5;           ///< Eq. 3: balance between box overlap, colour and embedding
  double min_score = 0.1;        ///< smallest score of a match
  double geometry_weight = 0.6;  ///< robust: weight of the 3D distance in the score
  double gate_sigmas = 3.5;      ///< robust: largest horizontal Mahalanobis distance of a match
  /// robust: largest horizontal distance of a match for any covariance
  double gate_m = 4.;
  double gate_vertical_m = 2.;  ///< robust: largest vertical distance of a match
};
void DescribeFields(FieldVisitor& visitor, AssociationOptions& options);

}  // namespace sslcd
