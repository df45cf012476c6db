// SPDX-License-Identifier: BSD-3-Clause

/// Stumpff functions: the one place where the angle of a rotation is divided by.
///
///   c_k(s) = sum_j (-s)^j / (k + 2j)!,   s = theta^2
///
///   c0 = cos(theta)                         c3 = (theta - sin(theta)) / theta^3
///   c1 = sin(theta) / theta                 c4 = (theta^2/2 - 1 + cos(theta)) / theta^4
///   c2 = (1 - cos(theta)) / theta^2         c5 = (theta^3/6 - theta + sin(theta)) / theta^5
///
/// Every coefficient of Exp, Log and the Jacobians of SO(3) and SE(3) is a small rational
/// expression in them (see so3.h, se3.h). They are entire functions of theta^2, not of
/// theta, so there is no square root at zero: a dual number (ceres::Jet) carries the right
/// derivative through theta = 0. Recurrence: c_k = 1/k! - s c_{k+2}.
#pragma once

#include <cmath>

namespace lie {

template <class T>
struct Stumpff {
  T c0, c1, c2, c3, c4, c5;
};

/// `s` is the squared angle, s >= 0. Relative error below about 1e-14 for double; the
/// series is used up to s = 2 because the closed forms cancel there.
template <class T>
Stumpff<T> EvaluateStumpff(const T& s) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  Stumpff<T> c;
  if (s < T(2.0)) {
    // Horner from the back; with 9 terms the first one left out is below 1e-19.
    constexpr int kTerms = 9;
    c.c4 = T(1.0);
    c.c5 = T(1.0);
    for (int j = kTerms; j > 0; --j) {
      c.c4 = T(1.0) - s * c.c4 * T(1.0 / ((2 * j + 3) * (2 * j + 4)));
      c.c5 = T(1.0) - s * c.c5 * T(1.0 / ((2 * j + 4) * (2 * j + 5)));
    }
    c.c4 = c.c4 * T(1.0 / 24.0);
    c.c5 = c.c5 * T(1.0 / 120.0);
    c.c3 = T(1.0 / 6.0) - s * c.c5;
    c.c2 = T(0.5) - s * c.c4;
    c.c1 = T(1.0) - s * c.c3;
    c.c0 = T(1.0) - s * c.c2;
  } else {
    const T theta = sqrt(s);
    const T inverse = T(1.0) / s;
    c.c0 = cos(theta);
    c.c1 = sin(theta) / theta;
    c.c2 = (T(1.0) - c.c0) * inverse;
    c.c3 = (T(1.0) - c.c1) * inverse;
    c.c4 = (T(0.5) - c.c2) * inverse;
    c.c5 = (T(1.0 / 6.0) - c.c3) * inverse;
  }
  return c;
}

/// atan(x) / x as a function of x^2, for 0 <= x^2 <= 0.04 (the range Log needs; truncation
/// below 1e-18).
template <class T>
T AtanOverX(const T& x_squared) {
  T sum = T(0.0);
  for (int k = 12; k >= 0; --k) sum = T(1.0 / (2 * k + 1)) - x_squared * sum;
  return sum;
}

}  // namespace lie
