// SPDX-License-Identifier: BSD-3-Clause
#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sslcd {

double LogSumExp(const std::vector<double>& values) {
  if (values.empty()) return -std::numeric_limits<double>::infinity();
  const double top = *std::max_element(values.begin(), values.end());
  if (!std::isfinite(top)) return top;
  double sum = 0;
  for (const double value : values) sum += std::exp(value - top);
  return top + std::log(sum);
}

double LogGamma(double x) {
  int sign = 0;
  return lgamma_r(x, &sign);
}

double LogBetaBinomial(double yes, double no, double prior_yes, double prior_no) {
  const auto log_beta = [](double a, double b) {
    return LogGamma(a) + LogGamma(b) - LogGamma(a + b);
  };
  return log_beta(yes + prior_yes, no + prior_no) - log_beta(prior_yes, prior_no);
}

double Chi2Quantile(double probability, int dof) {
  double low = -40, high = 40;  // the normal distribution's quantile by bisection
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.)) < probability ? low : high) = middle;
  }
  const double v = 2. / (9. * dof);
  return dof * std::pow(1 - v + low * std::sqrt(v), 3);
}

}  // namespace sslcd
