// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>

namespace sslcd {

/// The maximum of a function of the logs of two factors, by a pattern search that starts at zero,
/// with steps from a factor of e to a few per cent.
std::array<double, 2> MaximiseOverLogs(
    const std::function<double(const std::array<double, 2>&)>& value);

}  // namespace sslcd
