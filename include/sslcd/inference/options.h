// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"

namespace SSLCD_EXPORT sslcd {

/// How models are run.
struct InferenceOptions {
  enum class Provider { kCpu, kCuda };

  /// Path of libonnxruntime.so. Empty: the environment variable SSLCD_ORT_LIB, otherwise the usual
  /// names and places.
  std::string library;
  /// kCuda falls back to the CPU with a warning if CUDA is missing
  Provider provider = Provider::kCpu;
  int device_id = 0;  ///< which GPU
  int threads = 1;    ///< threads of one model; 1: only the calling thread
};
void DescribeFields(FieldVisitor& visitor, InferenceOptions& options);

}  // namespace sslcd
