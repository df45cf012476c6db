// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(IfFile, WhatIsThereButNoFileIsNotTakenForAbsent) {
  const TempFolder folder;
  const std::string path = folder.In("calib.txt");
  const auto refuse = [&path](const std::string& reason) {
    ExpectError([&] { IfFile(path); }, {"calib.txt: is there, but " + reason, "or remove it"});
    std::filesystem::remove(path);
  };
  EXPECT_EQ(IfFile(path), "");
  EXPECT_EQ(IfFile(path + "/below"), "");
  std::filesystem::create_symlink("nowhere", path);
  refuse("is a link that leads nowhere");
  std::filesystem::create_symlink("calib.txt", path);
  refuse("cannot be read (Too many levels");
  std::filesystem::create_directory(path);
  refuse("is a folder");
  folder.Write("other", "");
  std::filesystem::create_symlink("other", path);
  EXPECT_EQ(IfFile(path), path);
}

}  // namespace
}  // namespace sslcd
