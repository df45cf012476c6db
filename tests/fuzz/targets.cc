// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"

#include <stdexcept>

#include "sslcd/core/error.h"

namespace sslcd::fuzz {

Targets AllTargets() {
  Targets all;
  for (Targets some : {Readers(), Folders(), Maps(), Models(), Programs()}) all.merge(some);
  return all;
}

void Run(const Target& target, const std::string& bytes) {
  try {
    target(bytes);
  } catch (const Error&) {
  }
}

void MustSucceed(const char* what, const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    throw std::logic_error(std::string(what) + ": " + error.what());
  }
}

}  // namespace sslcd::fuzz
