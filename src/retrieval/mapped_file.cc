// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/regular_file.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

[[noreturn]] void FailToRead(const std::string& path, int code) {
  throw Error(ErrorKind::kBadInput, path + ": cannot be read: " + std::strerror(code) +
                                        (code == ENOENT ? "; `sslcd_run sites index` makes it"
                                                        : "; check its rights and the disk"));
}

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  RequireRegularFile(path);
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) FailToRead(path, errno);
  struct stat status = {};
  int code = fstat(file, &status) == 0 ? 0 : errno;
  size_ = static_cast<std::size_t>(status.st_size);
  if (code == 0 && size_ > 0) {
    void* const mapped = mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0);
    if (mapped == MAP_FAILED)
      code = errno;
    else
      data_ = static_cast<const char*>(mapped);
  }
  close(file);
  if (code != 0) FailToRead(path, code);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(const_cast<char*>(data_), size_);
}

}  // namespace sslcd
