// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace sslcd {

/// A checksum that finds damage, not forgery: every flipped bit changes it. Several GB a second.
std::uint64_t FastChecksum(const char* bytes, std::size_t size);

}  // namespace sslcd
