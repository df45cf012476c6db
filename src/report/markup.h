// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sslcd {

/// Text for HTML and SVG: no character of it is markup. Control characters are left out.
std::string MarkupText(const std::string& text);

}  // namespace sslcd
