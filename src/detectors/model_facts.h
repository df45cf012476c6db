// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "inference/session.h"

namespace sslcd {

/// What an ONNX file tells of itself without a description.
struct ModelFacts {
  std::string file;
  std::vector<TensorInfo> inputs, outputs;  ///< as declared; -1: any size
  std::vector<std::string> images;          ///< the inputs that take an image
  std::string size;                         ///< the input that takes width and height; empty: none
  int width_px = 0, height_px = 0;          ///< of the images
  std::vector<Tensor> answers;              ///< the outputs for a grey image
  std::map<int, std::string> class_names;   ///< stored in the file; empty: unknown
};

/// Loads the model and runs it once. `width_px` and `height_px` are for models that take images of
/// any size; 0: the model's own. Throws the errors of Session, and Error(kBadInput) with a remedy
/// if no input takes colour images (batch x 3 x height x width), if their size is open, is
/// another one than asked for, or too large with their number, or if there are inputs of another
/// kind.
ModelFacts InspectModel(const std::string& path, int width_px, int height_px,
                        const InferenceOptions& options);

}  // namespace sslcd
