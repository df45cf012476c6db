// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/detection.h"

namespace sslcd {

/// Whether pose and size have neither NaN nor infinity. Others are in no map.
inline bool HasFiniteGeometry(const Detection& detection) {
  return Eigen::Map<const Eigen::Matrix<double, Pose::kParameters, 1>>(
             detection.T_cam_object.data())
             .allFinite() &&
         detection.dims.allFinite();
}

}  // namespace sslcd
