// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd {

/// Text for HTML, SVG and KML: no character of it is markup. Characters that XML does not allow,
/// such as control characters, are left out. `text` is UTF-8.
std::string MarkupText(const std::string& text);

}  // namespace sslcd
