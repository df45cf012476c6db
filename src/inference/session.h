// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "inference/tensor.h"
#include "sslcd/inference/options.h"

namespace sslcd {

/// One input or output of a model.
struct TensorInfo {
  std::string name;
  TensorShape shape;  ///< -1: any size
  std::string type;   ///< "float32", "int64", ...
};

using NamedTensors = std::map<std::string, Tensor>;

/// A model that is loaded and ready to run, by ONNX Runtime 1.17 or later. Its library is loaded
/// when the first session is made: nothing else of sslcd needs it.
///
/// Throws Error(kBadInput) with the path and a way out: there is no runtime library, it is too old,
/// the model is missing, damaged, of an unknown version, or has inputs or outputs other than
/// numbers.
class Session {
 public:
  explicit Session(const std::string& model_path, const InferenceOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  const std::string& path() const;
  const std::vector<TensorInfo>& inputs() const;
  const std::vector<TensorInfo>& outputs() const;

  /// What it really runs on: kCpu where CUDA was asked for and is not there.
  InferenceOptions::Provider provider() const;

  /// All outputs for all inputs. Numbers are converted from and to the model's types. The same
  /// input gives the same output on one machine, provider and number of threads. Throws
  /// Error(kBadInput) naming the model when an input is missing or has another shape than the
  /// model's, when the model fails, or when an output is not finite.
  NamedTensors Run(const NamedTensors& inputs) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
