// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "input_file.h"
#include "sslcd/store/map_store.h"
#include "targets.h"

namespace sslcd::fuzz {
namespace {

// Each question by itself: a wrong checksum of the results says nothing of the inputs.
void ReadMap(const std::string& bytes) {
  const std::string path = EmptyFolder() + "/map.sslcd";
  std::ofstream(path, std::ios::binary) << bytes;
  const Target questions[] = {
      [](const std::string& map) { MapStore(map).Describe(); },
      [](const std::string& map) { MapStore(map).Results(); },
      [](const std::string& map) { MapStore(map).History(); },
      [](const std::string& map) { MapStore(map).Reference(); },
      [](const std::string& map) { MapStore(map).Verify(); },
      [](const std::string& map) { HasMap(map); },
      [](const std::string& map) { CompactMap(map); },
  };
  for (const Target& question : questions) Run(question, path);
}

}  // namespace

Targets Maps() { return {{"map", ReadMap}}; }

}  // namespace sslcd::fuzz
