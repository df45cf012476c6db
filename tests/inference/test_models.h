// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "inference/session.h"
#include "sslcd/core/error.h"

namespace sslcd {

/// A file of tests/data/models.
inline std::string TestModel(const std::string& name) {
  const std::filesystem::path here = std::filesystem::absolute(__FILE__).parent_path();
  return (here / "../data/models" / name).lexically_normal().string();
}

/// Why no model can be run here; empty: they can.
inline std::string NoRuntime() {
  try {
    Session(TestModel("yolo_v5.onnx"));
  } catch (const Error& error) {
    const std::string why = error.what();
    if (why.find("which was not found") != std::string::npos) return why;
  }
  return "";
}

#define SSLCD_RUNTIME()                                  \
  if (const std::string why = NoRuntime(); !why.empty()) \
  GTEST_SKIP() << "skipped: no ONNX Runtime: " << why

}  // namespace sslcd
