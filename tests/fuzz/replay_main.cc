// SPDX-License-Identifier: BSD-3-Clause
// replay DIR: runs each target on the files of DIR/TARGET, without libFuzzer. Exit code 1 if one of
// them throws anything but Error, or if a target has no file.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "targets.h"

namespace {

namespace fs = std::filesystem;

bool Replay(const fs::path& file, const sslcd::fuzz::Target& target) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  try {
    sslcd::fuzz::Run(target, bytes);
    return true;
  } catch (const std::exception& exception) {
    std::printf("%s: %s\n", file.c_str(), exception.what());
    return false;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  int files = 0, failed = 0;
  for (const auto& [name, target] : sslcd::fuzz::AllTargets()) {
    int of_target = 0;
    std::error_code none;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(fs::path(argv[1]) / name, none)) {
      failed += !Replay(entry.path(), target);
      ++of_target;
    }
    if (of_target == 0) std::printf("%s: no inputs\n", name.c_str());
    failed += of_target == 0;
    files += of_target;
  }
  std::printf("%d inputs, %d failed\n", files, failed);
  return failed == 0 ? 0 : 1;
}
