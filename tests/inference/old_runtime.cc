// SPDX-License-Identifier: BSD-3-Clause
// Stands for a libonnxruntime.so that is too old: it knows no table of functions of the version
// that is asked for.
#include <onnxruntime_c_api.h>

#include <cstdint>

namespace {

const OrtApi* ORT_API_CALL NoApi(std::uint32_t) noexcept { return nullptr; }
const char* ORT_API_CALL Version() noexcept { return "1.4.0"; }

}  // namespace

const OrtApiBase* ORT_API_CALL OrtGetApiBase() noexcept {
  static const OrtApiBase base{NoApi, Version};
  return &base;
}
