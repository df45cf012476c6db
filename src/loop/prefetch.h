// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace sslcd {

/// Asks the processor to load memory that is needed soon. Changes no result.
inline void Prefetch(const void* memory, std::size_t bytes) {
  constexpr std::size_t kLine = 64;
  const char* const from = static_cast<const char*>(memory);
  for (std::size_t i = 0; i < bytes; i += kLine) __builtin_prefetch(from + i);
}

}  // namespace sslcd
