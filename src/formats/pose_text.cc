// SPDX-License-Identifier: BSD-3-Clause
#include "formats/pose_text.h"

#include "formats/number_text.h"

namespace sslcd {

std::string PoseText(const Pose& T) {
  const auto& q = T.unit_quaternion();
  const double sign = q.w() < 0 ? -1. : 1.;
  std::string text;
  for (int i = 0; i < 3; ++i) text += FixedNumber(T.translation()[i], 9) + " ";
  for (const double component : {q.x(), q.y(), q.z()})
    text += FixedNumber(sign * component, 9) + " ";
  return text + FixedNumber(sign * q.w(), 9);
}

}  // namespace sslcd
