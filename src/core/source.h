// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

namespace sslcd {

/// Returns items in order, e.g. the frames of a sequence; none after the last one. It may throw and
/// is not called again after that.
template <class T>
using Source = std::function<std::optional<T>()>;

}  // namespace sslcd
