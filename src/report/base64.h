// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd {

/// Bytes as text (RFC 4648), for data in a page.
std::string Base64(const std::string& bytes);

}  // namespace sslcd
