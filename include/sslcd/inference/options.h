// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/fields.h"

namespace sslcd {

/// How models are run.
struct InferenceOptions {
  enum class Provider { kCpu, kCuda };

  /// Path of libonnxruntime.so. Empty: environment SSLCD_ORT_LIB, else the usual names and places.
  std::string library;
  /// kCuda falls back to the CPU, with a warning, where it is not there
  Provider provider = Provider::kCpu;
  int device_id = 0;  ///< which GPU
  int threads = 1;    ///< threads of one model; 1: only the one that calls
};
void DescribeFields(FieldVisitor& visitor, InferenceOptions& options);

}  // namespace sslcd
