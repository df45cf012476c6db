// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sslcd {

struct Interval {
  double low = 0, high = 1;
};

/// Wilson's score interval of a proportion: where the true rate lies after `successes` of `trials`,
/// with the confidence of `z` standard deviations (default: 95 %). Sensible for few trials and for
/// rates near 0 and 1; without trials it is [0, 1]. Throws Error (kUsage) unless 0 <= successes <=
/// trials and z >= 0. Source: Wilson, JASA 1927.
Interval WilsonInterval(int successes, int trials, double z = 1.959963984540054);

}  // namespace sslcd
