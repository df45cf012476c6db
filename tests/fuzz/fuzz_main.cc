// SPDX-License-Identifier: BSD-3-Clause
// The entry points of libFuzzer. SSLCD_FUZZ_TARGET names the target; without it the names of all
// targets are printed. SSLCD_FUZZ_SECONDS: CPU time that an input may take; unlike libFuzzer's
// limit it does not count what other programs use.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "targets.h"

namespace {

sslcd::fuzz::Target g_target;
double g_most_seconds = 1;

double CpuSeconds() {  // of all threads
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("SSLCD_FUZZ_TARGET");
  for (const auto& [each, target] : sslcd::fuzz::AllTargets())
    if (name == nullptr)
      std::printf("%s\n", each.c_str());
    else if (each == name)
      g_target = target;
  if (const char* seconds = std::getenv("SSLCD_FUZZ_SECONDS")) g_most_seconds = std::atof(seconds);
  if (!g_target) std::exit(name == nullptr ? 0 : 2);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const double start = CpuSeconds();
  sslcd::fuzz::Run(g_target, std::string(reinterpret_cast<const char*>(data), size));
  if (const double taken = CpuSeconds() - start; taken > g_most_seconds) {
    std::fprintf(stderr, "too slow: %.1f s of CPU time\n", taken);
    std::abort();
  }
  return 0;
}
