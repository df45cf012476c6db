// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sslcd/core/error.h"

namespace sslcd {

/// A folder of its own for each test, gone afterwards.
class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sslcd_io_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string In(const std::string& name) const {
    return (std::filesystem::path(path_) / name).string();
  }

  /// Writes a file, making the folders on the way; returns its path.
  std::string Write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = std::filesystem::path(path_) / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }

 private:
  std::string path_;
};

/// Runs `call`, which must throw an Error whose message holds all `parts`.
template <class Call>
void ExpectError(const Call& call, const std::vector<std::string>& parts) {
  try {
    call();
    ADD_FAILURE() << "no error thrown; expected one about: " << parts.front();
  } catch (const Error& error) {
    for (const std::string& part : parts) EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

/// Folder of real data, or empty. Without SSLCD_DATA_DIR it is looked for beside the source tree.
inline std::string RealData(const std::string& name) {
  const char* root = std::getenv("SSLCD_DATA_DIR");
  const std::filesystem::path beside =
      std::filesystem::path(__FILE__).parent_path() / "../../../shared/data";
  const std::filesystem::path folder =
      (root != nullptr ? std::filesystem::path(root) : beside) / name;
  return std::filesystem::exists(folder) ? folder.string() : "";
}

#define SSLCD_REAL_DATA(variable, name)        \
  const std::string variable = RealData(name); \
  if (variable.empty()) GTEST_SKIP() << "skipped: no data (" name "), set SSLCD_DATA_DIR"

}  // namespace sslcd
