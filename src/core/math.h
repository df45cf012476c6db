// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace sslcd {

/// log(sum(exp(values))) without overflow; minus infinity for no values.
double LogSumExp(const std::vector<double>& values);

/// log |Gamma(x)|. Unlike std::lgamma it writes no global sign, so threads may call it.
double LogGamma(double x);

/// Log probability of a sequence of `yes` and `no` outcomes of unknown rate: the Beta-binomial.
double LogBetaBinomial(double yes, double no, double prior_yes, double prior_no);

/// The quantile of the chi-squared distribution with `dof` degrees of freedom; Wilson and
/// Hilferty's approximation (within 0.5 % for dof >= 3 and probabilities from .9 to .999).
double Chi2Quantile(double probability, int dof);

/// Standard deviation of a normal distribution per median absolute deviation.
inline constexpr double kSigmaPerMad = 1.4826;

}  // namespace sslcd
