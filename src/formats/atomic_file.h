// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sslcd {

enum class Durability {
  kSynced,   ///< on the disk when the function returns: it survives a loss of power
  kUnsynced  ///< when the system writes it: for pictures, of which there are thousands
};

/// Writes a whole file or nothing: it writes a temporary file in the same folder and renames it. A
/// killed program or a full disk never leaves half a file under the final name. A target that
/// exists and is not a regular file (a device, a pipe) is written directly. Throws Error(kOutput)
/// with the path and the system's reason.
void WriteFileAtomically(const std::string& path, const std::string& content,
                         Durability durability = Durability::kSynced);

/// The same for several files (path, content). Renames the files only after all are written, so a
/// full disk does not leave a mixture of old and new files.
void WriteFilesAtomically(const std::vector<std::pair<std::string, std::string>>& files,
                          Durability durability = Durability::kSynced);

/// Throws Error(kOutput) if no file can have this path, because a folder has it or its own folder
/// is not there: before long work whose result it takes, not after it.
void RequirePlaceOf(const std::string& path);

/// Creates the folder and its parents, on the disk, and checks that a file can be written there.
/// Throws Error(kOutput).
void MakeWritableFolder(const std::string& path);

}  // namespace sslcd
