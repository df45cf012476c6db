// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <onnxruntime_c_api.h>

#include <memory>
#include <string>

namespace sslcd {

/// ONNX Runtime's table of functions. Only functions of 1.17 are in it, however new header and
/// library are. `library` as InferenceOptions::library. The library stays loaded until the process
/// ends: it cannot be unloaded safely. Throws Error(kBadInput) when there is none, or it is too
/// old, or is something else.
const OrtApi& LoadRuntime(const std::string& library);

/// Frees what a release function of the API frees.
template <class T>
using OrtPointer = std::unique_ptr<T, void (*)(T*)>;

/// Text of a failed call, its first line, and frees it; "" for success.
std::string Problem(const OrtApi& api, OrtStatus* status);

}  // namespace sslcd
