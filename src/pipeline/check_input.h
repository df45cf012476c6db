// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/frame_store.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Checks of what a host hands to a mapper. All throw Error(kBadInput).

/// The up direction has no unit length, or a camera has no positive focal lengths.
void CheckContext(const MapperContext& context);

/// The pose or stamp of the next frame is not finite or farther away than the Earth is round, its
/// number or its stamp is not above that of the frame before, or the uncertainty of its step is
/// negative or not finite. The stamp of the first frame of a sequence may be any.
void CheckFrame(const Frame& frame, const FrameStore& frames, bool starts_sequence);

}  // namespace sslcd
