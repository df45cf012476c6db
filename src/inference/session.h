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

/// A model that is loaded and ready to run, by ONNX Runtime 1.17 or later. The first session loads
/// the runtime library; nothing else of sslcd needs it.
/// Throws Error(kBadInput) with the path and a remedy if the runtime library is missing or too old,
/// or if the model is missing, damaged, of an unknown version, or has inputs or outputs that are
/// not numbers.
class Session {
 public:
  explicit Session(const std::string& model_path, const InferenceOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  const std::string& path() const;
  const std::vector<TensorInfo>& inputs() const;
  const std::vector<TensorInfo>& outputs() const;

  /// A text that the model's author has stored under this key, e.g. the "names" of the classes in
  /// ultralytics' files; empty if there is none.
  std::string Metadata(const std::string& key) const;

  /// The device in use: kCpu if CUDA was requested but is missing.
  InferenceOptions::Provider provider() const;

  /// Computes all outputs from all inputs. Converts numbers from and to the model's types. The same
  /// input gives the same output on the same machine, provider and number of threads. Throws
  /// Error(kBadInput) with the name of the model if an input is missing or has a wrong shape, if
  /// the model fails, or if an output is not finite.
  NamedTensors Run(const NamedTensors& inputs) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
