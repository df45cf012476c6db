// SPDX-License-Identifier: BSD-3-Clause
// The entry points of libFuzzer. SSLCD_FUZZ_TARGET names the target; without it the names of all
// targets are printed.
#include <cstdio>
#include <cstdlib>

#include "targets.h"

namespace {

sslcd::fuzz::Target g_target;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("SSLCD_FUZZ_TARGET");
  for (const auto& [each, target] : sslcd::fuzz::AllTargets())
    if (name == nullptr)
      std::printf("%s\n", each.c_str());
    else if (each == name)
      g_target = target;
  if (!g_target) std::exit(name == nullptr ? 0 : 2);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  sslcd::fuzz::Run(g_target, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
