// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Adds `newer` changes to those that a host has not taken yet. Together they are no more than all
/// frames and all attempts.
void MergeChanges(MapChanges newer, MapChanges& changes);

}  // namespace sslcd
