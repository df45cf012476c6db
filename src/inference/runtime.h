// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <onnxruntime_c_api.h>

#include <memory>
#include <string>

namespace sslcd {

/// ONNX Runtime's table of functions, restricted to version 1.17 for any version of header and
/// library. `library` is InferenceOptions::library. The library stays loaded until the process
/// ends, because it cannot be unloaded safely. Throws Error(kBadInput) if the library is missing,
/// too old or not ONNX Runtime.
const OrtApi& LoadRuntime(const std::string& library);

/// Deletes an object by its release function of the API.
template <class T>
using OrtPointer = std::unique_ptr<T, void (*)(T*)>;

/// Returns the first line of the message of a failed call and frees the status; "" on success.
std::string Problem(const OrtApi& api, OrtStatus* status);

}  // namespace sslcd
