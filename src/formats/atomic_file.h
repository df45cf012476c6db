// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sslcd {

/// Writes a whole file or nothing: first under a temporary name beside it, then renamed, so that a
/// killed program or a full disk never leaves half a file under the final name. A target that
/// exists and is no regular file (a device, a pipe) is written directly. Throws Error(kOutput) with
/// the path and the system's reason.
void WriteFileAtomically(const std::string& path, const std::string& content);

/// The same for several (path, content): none has its name before all are there, so that a full
/// disk leaves no mixture.
void WriteFilesAtomically(const std::vector<std::pair<std::string, std::string>>& files);

/// Makes the folder (and those above it) and checks that a file can be written there. Throws
/// Error(kOutput).
void MakeWritableFolder(const std::string& path);

}  // namespace sslcd
