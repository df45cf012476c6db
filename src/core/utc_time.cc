// SPDX-License-Identifier: BSD-3-Clause
#include "core/utc_time.h"

#include <ctime>

namespace sslcd {

std::string UtcTime() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  const std::size_t size = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return std::string(text, size);
}

}  // namespace sslcd
