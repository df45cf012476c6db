// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sslcd/store/map_store.h"
#include "store/database.h"

namespace sslcd {

enum class InputKind { kFrame, kSequence, kRefinement };

/// One call of the mapper: the inputs of a map in order are what it is made from.
struct StoredInput {
  int session = 0;
  InputKind kind = InputKind::kFrame;
  std::string content;  ///< frame_bytes.h; empty for kSequence
};

/// The checksum of a session before its first input, and after one more.
std::string FirstChecksum();
std::string NextChecksum(const std::string& before, InputKind kind, const std::string& content);

/// The frame of an input of kind kFrame. Throws ThrowDamaged if the content is none.
Frame FrameIn(const StoredInput& input, const std::string& path);

void AppendInputs(Database& database, const std::vector<StoredInput>& inputs);

/// Hands out all inputs in order. Returns what is wrong with their numbers and checksums, one
/// sentence per session; empty: they are those that were stored.
std::vector<std::string> ReadInputs(Database& database, const std::vector<SessionInfo>& sessions,
                                    const std::function<void(const StoredInput&)>& take);

}  // namespace sslcd
