// SPDX-License-Identifier: BSD-3-Clause
#include "formats/file_set.h"

#include <filesystem>

#include "formats/atomic_file.h"
#include "formats/files.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

const std::string kMark = ".sslcd-unfinished-";

void Remove(const std::string& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error)
    throw Error(ErrorKind::kOutput, path + ": cannot be removed: " + error.message() +
                                        "; check the rights of its folder");
}

}  // namespace

void WriteFileSet(FileSet set) {
  const std::string mark = (fs::path(set.folder) / (kMark + set.name)).string();
  // files get their names in this order
  set.files.insert(set.files.begin(), {mark, "Files of two calls of sslcd may be here.\n"});
  WriteFilesAtomically(set.files);
  for (const std::string& path : set.removed) Remove(path);
  Remove(mark);
}

void RefuseUnfinished(const std::string& folder) {
  for (const std::string& name : FileNames(folder))
    if (name.rfind(kMark, 0) == 0)
      throw Error(ErrorKind::kBadInput,
                  folder +
                      ": its files may be of two calls, because sslcd is replacing them, or was "
                      "stopped while it did; repeat the command that wrote them, or delete " +
                      (fs::path(folder) / name).string() + " to use them as they are");
}

}  // namespace sslcd
