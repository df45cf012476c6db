// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"
#include "sslcd/store/map_store.h"
#include "store/database.h"

namespace sslcd {

/// The rows of a map that are not results. The lists of inputs are in journal.h.
MapInfo ReadInfo(Database& database);
void WriteNewSite(Database& database, const MapInfo& info);  ///< site, labels
/// Inserts or replaces.
void WriteLabel(Database& database, const std::string& name, const LabelInfo& label);
void WriteVectorLength(Database& database, Cue cue, int length);
void WriteSession(Database& database, const SessionInfo& session);

std::string ConfigText(Options options);
/// Throws Error(kBadConfig) for keys that this version does not know.
Options OptionsOf(const MapInfo& info, const std::string& path);

/// Throws Error if a session with this context and these options does not belong to the map:
/// kBadInput for another site, kUsage for other options.
void CheckBelongs(const MapInfo& info, const std::string& path, const MapperContext& context,
                  const std::optional<Options>& options);
bool IsSame(const Camera& a, const Camera& b);
/// The number in the map of a frame of a session. Throws Error(kBadInput) if it is none; `path`: of
/// the map, for the message.
int NumberInMap(int frame, const SessionInfo& session, const std::string& path);
/// Throws Error(kBadInput) if a vector of the frame has another length than those of the map.
void CheckVectorLengths(const MapInfo& info, const std::string& path, const Frame& frame);

}  // namespace sslcd
