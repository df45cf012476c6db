// SPDX-License-Identifier: BSD-3-Clause
#include "inference/runtime.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::uint32_t kApiVersion = 17;
const char kHelp[] =
    "install it (scripts/install_onnxruntime.sh, with --to FOLDER without root; or the package "
    "libonnxruntime-dev), or give the path of libonnxruntime.so as 'library' or in SSLCD_ORT_LIB; "
    "nothing has to be built again";

/// The paths to try and the source of their names.
struct Candidates {
  std::vector<std::string> paths;
  std::string named_by;  // empty: the usual places
};

Candidates CandidatesFor(const std::string& library) {
  if (!library.empty()) return {{library}, "'library'"};
  const char* from_environment = std::getenv("SSLCD_ORT_LIB");
  if (from_environment && *from_environment) return {{from_environment}, "SSLCD_ORT_LIB"};
  return {{"libonnxruntime.so.1", "libonnxruntime.so", "/usr/local/lib/libonnxruntime.so.1",
           "/usr/local/lib/libonnxruntime.so"},
          ""};
}

}  // namespace

const OrtApi& LoadRuntime(const std::string& library) {
  const Candidates candidates = CandidatesFor(library);
  void* handle = nullptr;
  std::string path, reason;
  for (const std::string& candidate : candidates.paths) {
    handle = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    path = candidate;
    if (handle) break;
    const char* problem = dlerror();
    if (reason.empty() && problem) reason = problem;
  }
  if (!handle) {
    throw Error(ErrorKind::kBadInput,
                "models need ONNX Runtime, which was not found" +
                    (candidates.named_by.empty() ? "" : " where " + candidates.named_by + " says") +
                    " (" + reason + "): " + kHelp);
  }
  using GetApiBase = const OrtApiBase*(ORT_API_CALL*)();
  const auto get_api_base = reinterpret_cast<GetApiBase>(dlsym(handle, "OrtGetApiBase"));
  if (!get_api_base)
    throw Error(ErrorKind::kBadInput, {path}, std::string("is not ONNX Runtime: ") + kHelp);
  const OrtApiBase* base = get_api_base();
  const OrtApi* api = base->GetApi(kApiVersion);
  if (!api) {
    throw Error(ErrorKind::kBadInput, {path},
                std::string("is ONNX Runtime ") + base->GetVersionString() + ", but 1." +
                    std::to_string(kApiVersion) + " or later is needed: " + kHelp);
  }
  return *api;
}

std::string Problem(const OrtApi& api, OrtStatus* status) {
  if (!status) return "";
  constexpr std::size_t kLongest = 300;
  std::string text = api.GetErrorMessage(status);
  api.ReleaseStatus(status);
  text.resize(std::min({text.size(), text.find('\n'), kLongest}));
  return text.empty() ? "no reason given" : text;
}

}  // namespace sslcd
