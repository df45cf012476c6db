// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detectors/model_description.h"
#include "detectors/prepare.h"
#include "inference/session.h"
#include "sslcd/core/timing.h"

namespace sslcd {

/// A loaded model with its description. It maps images to outputs in the order of the layout.
class Model {
 public:
  /// Throws Error if the layout is not for `task`, or if the model's inputs or outputs do not match
  /// the description.
  Model(const std::string& yaml_path, ModelTask task, const InferenceOptions& options);

  const ModelDescription& description() const { return description_; }
  int width() const { return width_; }  ///< width of the input [px]
  int height() const { return height_; }
  bool takes_two_images() const { return description_.output.layout == ModelLayout::kStereo3d; }
  int fixed_batch() const { return fixed_batch_; }  ///< batch size of the model; 0: any

  /// A tensor for `batch` images.
  Tensor EmptyInput(int batch) const;

  /// Runs the model. `right` is for models with two images. Throws Error if an output does not have
  /// the layout's shape.
  std::vector<Tensor> Run(Tensor left, std::optional<Tensor> right = std::nullopt) const;

  /// Measures the time of one stage until its destruction, if there is a table.
  std::optional<ScopedTimer> Time(TimingTable* timing, const char* stage) const;

 private:
  const TensorInfo& InputNamed(const std::string& name, std::size_t position) const;
  void ReadInputs();
  void ReadOutputs();
  [[noreturn]] void Refuse(const std::string& message) const;

  std::string yaml_path_;
  ModelDescription description_;
  Session session_;
  std::string left_name_, right_name_;
  std::vector<std::string> output_names_;
  std::vector<TensorShape> output_shapes_;  ///< shapes that the layout requires
  int width_ = 0, height_ = 0, fixed_batch_ = 1;
};

/// The shapes of a layout's outputs for an input of this size; -1: any size.
std::vector<TensorShape> LayoutShapes(const ModelOutput& output, int width, int height);

}  // namespace sslcd
