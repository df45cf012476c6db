// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

namespace sslcd {

/// Hands out items in order, e.g. the frames of a sequence; none: that was the last one. May throw,
/// and is not asked again then.
template <class T>
using Source = std::function<std::optional<T>()>;

}  // namespace sslcd
