// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check/checks.h"
#include "datasets/sequence_writer.h"

namespace sslcd::check {

/// The corrected sequence. Throws Error(kBadInput) if there is nothing to correct, or if a mistake
/// cannot be corrected from the data. Detections of frames without a pose are left out.
SequenceFiles RepairedFiles(const CheckReport& report);

}  // namespace sslcd::check
