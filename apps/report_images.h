// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/run_view.h"

namespace sslcd::apps {

/// Cuts the matched objects of accepted loops out of the images that the run lists among its
/// inputs, as small JPEG files of at most 2 MB together, and notes why there are none, or not of
/// all loops. Without images it does nothing. Reads no folder but that one, and only if the
/// number and total size of its files are those of the run.
void AddLoopImages(RunView& run);

}  // namespace sslcd::apps
