// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace sslcd {

/// Returns JSON with one line per element of `rows`, a list or object inside `root` or `root`
/// itself. Everything else is on one line. Numbers have the shortest text that reads back as the
/// same number; NaN and infinity become null. Bytes that are not UTF-8 become U+FFFD.
std::string JsonText(const nlohmann::ordered_json& root, const nlohmann::ordered_json& rows);

}  // namespace sslcd
