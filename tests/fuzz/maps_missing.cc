// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"

namespace sslcd::fuzz {

Targets Maps() { return {}; }

}  // namespace sslcd::fuzz
