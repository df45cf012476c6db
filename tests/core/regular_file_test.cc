// SPDX-License-Identifier: BSD-3-Clause
#include "core/regular_file.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>

#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(RegularFile, WhatMayNeverEndIsRefused) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo(folder.In("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("pipe", folder.In("link"));
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  std::strncpy(name.sun_path, folder.In("socket").c_str(), sizeof name.sun_path - 1);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(listener, reinterpret_cast<const sockaddr*>(&name), sizeof name), 0);
  const auto refuse = [](const std::string& path, const std::string& what) {
    ExpectError([&] { RequireRegularFile(path); }, {path + ": is a " + what, "expected a file"});
  };
  refuse(folder.In("pipe"), "pipe");
  refuse(folder.In("link"), "pipe");
  refuse(folder.In("socket"), "socket");
  refuse("/dev/zero", "device");
  refuse(folder.In(""), "folder");
  ::close(listener);
}

TEST(RegularFile, AFileAndNothingAreAccepted) {
  const TempFolder folder;
  EXPECT_NO_THROW(RequireRegularFile(folder.Write("file", "")));
  EXPECT_NO_THROW(RequireRegularFile(folder.In("nothing")));
}

}  // namespace
}  // namespace sslcd
