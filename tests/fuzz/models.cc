// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/model_description.h"
#include "inference/session.h"
#include "input_file.h"
#include "targets.h"

namespace sslcd::fuzz {

Targets Models() {
  return {
      {"model_yaml", [](const std::string& bytes) { LoadModelDescription(FileWith(bytes)); }},
      {"onnx", [](const std::string& bytes) { Session session(FileWith(bytes)); }},
  };
}

}  // namespace sslcd::fuzz
