// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/pipeline/mapper.h"
#include "sslcd/store/map_store.h"
#include "store/frame_bytes.h"
#include "store/journal.h"

namespace sslcd {

/// What a merge reads of a map: one state of the file.
struct MergeSource {
  std::string path;
  MapInfo info;
  std::vector<StoredInput> inputs;  ///< of all sessions, in order
};

/// Throws Error(kBadInput) if the file is no sound map.
MergeSource ReadMergeSource(const std::string& path);

/// The context that a session of this map is added to another one with. Its ViewAligner gives the
/// answers that are stored, so no images are needed; other pairs of frames have none.
MapperContext ContextOf(const MergeSource& source, const SessionInfo& session);

}  // namespace sslcd
