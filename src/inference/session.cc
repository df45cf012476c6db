// SPDX-License-Identifier: BSD-3-Clause
#include "inference/session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "core/regular_file.h"
#include "inference/runtime.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"

namespace sslcd {
namespace {

const char* NameOf(ONNXTensorElementDataType type) {
  switch (type) {
    case ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT: return "float32";
    case ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64: return "int64";
    case ONNX_TENSOR_ELEMENT_DATA_TYPE_INT32: return "int32";
    default: return nullptr;
  }
}

void ForwardLog(void*, OrtLoggingLevel level, const char*, const char*, const char*,
                const char* message) {
  Log(level >= ORT_LOGGING_LEVEL_ERROR ? LogLevel::kError : LogLevel::kWarning,
      std::string("ONNX Runtime: ") + message);
}

}  // namespace

struct Session::Impl {
  std::string path;
  const OrtApi& api;
  OrtPointer<OrtEnv> env;
  OrtPointer<OrtSession> session;
  InferenceOptions::Provider provider = InferenceOptions::Provider::kCpu;
  std::vector<TensorInfo> inputs, outputs;

  Impl(const std::string& model_path, const InferenceOptions& options)
      : path(model_path),
        api(LoadRuntime(options.library)),
        env(nullptr, api.ReleaseEnv),
        session(nullptr, api.ReleaseSession) {
    OrtEnv* created = nullptr;
    Check(api.CreateEnvWithCustomLogger(ForwardLog, nullptr, ORT_LOGGING_LEVEL_WARNING, "sslcd",
                                        &created));
    env.reset(created);
    Open(options);
    inputs =
        Describe(api.SessionGetInputCount, api.SessionGetInputName, api.SessionGetInputTypeInfo);
    outputs =
        Describe(api.SessionGetOutputCount, api.SessionGetOutputName, api.SessionGetOutputTypeInfo);
  }

  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(ErrorKind::kBadInput, {path}, message);
  }

  void Check(OrtStatus* status, const std::string& way_out = "") const {
    const std::string problem = Problem(api, status);
    if (!problem.empty()) Fail("ONNX Runtime says: " + problem + way_out);
  }

  void Open(const InferenceOptions& options) {
    if (options.provider == InferenceOptions::Provider::kCuda) {
      const std::string problem = Problem(api, TryToOpen(options));
      if (problem.empty()) {
        provider = InferenceOptions::Provider::kCuda;
        return;
      }
      Log(LogLevel::kWarning,
          path + ": runs on the CPU, because CUDA is missing (" + problem +
              "); 'library' must be ONNX Runtime's GPU build, with its CUDA and cuDNN");
    }
    InferenceOptions on_cpu = options;
    on_cpu.provider = InferenceOptions::Provider::kCpu;
    Check(TryToOpen(on_cpu),
          "; if it is an ONNX file, export the model again, in a version of ONNX that ONNX Runtime "
          "knows (docs/models.md)");
  }

  OrtStatus* TryToOpen(const InferenceOptions& options) {
    OrtSessionOptions* raw = nullptr;
    Check(api.CreateSessionOptions(&raw));
    const OrtPointer<OrtSessionOptions> settings(raw, api.ReleaseSessionOptions);
    Check(api.SetIntraOpNumThreads(raw, options.threads));
    Check(api.SetInterOpNumThreads(raw, 1));
    // idle threads must not spin
    Check(api.AddSessionConfigEntry(raw, "session.intra_op.allow_spinning", "0"));
    if (options.provider == InferenceOptions::Provider::kCuda)
      if (OrtStatus* problem = AddCuda(raw, options.device_id)) return problem;
    OrtSession* opened = nullptr;
    OrtStatus* problem = api.CreateSession(env.get(), path.c_str(), raw, &opened);
    session.reset(opened);
    return problem;
  }

  OrtStatus* AddCuda(OrtSessionOptions* settings, int device_id) const {
    OrtCUDAProviderOptionsV2* raw = nullptr;
    if (OrtStatus* problem = api.CreateCUDAProviderOptions(&raw)) return problem;
    const OrtPointer<OrtCUDAProviderOptionsV2> cuda(raw, api.ReleaseCUDAProviderOptions);
    const std::string device = std::to_string(device_id);
    const std::array<const char*, 1> keys = {"device_id"}, values = {device.c_str()};
    if (OrtStatus* problem =
            api.UpdateCUDAProviderOptions(raw, keys.data(), values.data(), keys.size()))
      return problem;
    return api.SessionOptionsAppendExecutionProvider_CUDA_V2(settings, raw);
  }

  template <class CountOf, class NameAt, class TypeAt>
  std::vector<TensorInfo> Describe(CountOf count_of, NameAt name_at, TypeAt type_at) const {
    OrtAllocator* allocator = nullptr;
    Check(api.GetAllocatorWithDefaultOptions(&allocator));
    std::size_t count = 0;
    Check(count_of(session.get(), &count));
    std::vector<TensorInfo> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      char* name = nullptr;
      Check(name_at(session.get(), i, allocator, &name));
      result[i].name = name;
      Check(api.AllocatorFree(allocator, name));
      OrtTypeInfo* raw = nullptr;
      Check(type_at(session.get(), i, &raw));
      const OrtPointer<OrtTypeInfo> type(raw, api.ReleaseTypeInfo);
      const OrtTensorTypeAndShapeInfo* tensor = nullptr;
      Check(api.CastTypeInfoToTensorInfo(raw, &tensor));
      ONNXTensorElementDataType element = ONNX_TENSOR_ELEMENT_DATA_TYPE_UNDEFINED;
      if (tensor) Check(api.GetTensorElementType(tensor, &element));
      if (!NameOf(element))
        Fail("'" + result[i].name +
             "' is not a tensor of float32, int32 or int64; export the model in float32");
      result[i].type = NameOf(element);
      result[i].shape = ShapeOf(tensor);
    }
    return result;
  }

  TensorShape ShapeOf(const OrtTensorTypeAndShapeInfo* info) const {
    std::size_t dimensions = 0;
    Check(api.GetDimensionsCount(info, &dimensions));
    TensorShape shape(dimensions);
    Check(api.GetDimensions(info, shape.data(), dimensions));
    return shape;
  }

  /// A tensor in the runtime's memory with the model's type.
  template <class T>
  OrtPointer<OrtValue> Copy(const Tensor& tensor, ONNXTensorElementDataType type) const {
    OrtAllocator* allocator = nullptr;
    Check(api.GetAllocatorWithDefaultOptions(&allocator));
    OrtValue* raw = nullptr;
    Check(api.CreateTensorAsOrtValue(allocator, tensor.shape.data(), tensor.shape.size(), type,
                                     &raw));
    OrtPointer<OrtValue> value(raw, api.ReleaseValue);
    void* data = nullptr;
    Check(api.GetTensorMutableData(raw, &data));
    std::copy(tensor.values.begin(), tensor.values.end(), static_cast<T*>(data));
    return value;
  }

  OrtPointer<OrtValue> MakeValue(const TensorInfo& info, const NamedTensors& named) const {
    const auto found = named.find(info.name);
    if (found == named.end()) Fail("no value for its input '" + info.name + "'");
    const Tensor& tensor = found->second;
    if (!Fits(tensor.shape, info.shape) || tensor.values.size() != ElementCount(tensor.shape))
      Fail("input '" + info.name + "' is " + ToString(tensor.shape) + ", the model takes " +
           ToString(info.shape));
    if (info.type == "int64")
      return Copy<std::int64_t>(tensor, ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64);
    if (info.type == "int32")
      return Copy<std::int32_t>(tensor, ONNX_TENSOR_ELEMENT_DATA_TYPE_INT32);
    return Copy<float>(tensor, ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT);
  }

  Tensor ReadValue(const TensorInfo& info, OrtValue* value) const {
    OrtTensorTypeAndShapeInfo* raw = nullptr;
    Check(api.GetTensorTypeAndShape(value, &raw));
    const OrtPointer<OrtTensorTypeAndShapeInfo> type(raw, api.ReleaseTensorTypeAndShapeInfo);
    Tensor tensor{ShapeOf(raw), {}};
    void* data = nullptr;
    Check(api.GetTensorMutableData(value, &data));
    const std::size_t count = ElementCount(tensor.shape);
    const auto read = [&](const auto* first) { tensor.values.assign(first, first + count); };
    if (info.type == "int64") {
      read(static_cast<const std::int64_t*>(data));
    } else if (info.type == "int32") {
      read(static_cast<const std::int32_t*>(data));
    } else {
      read(static_cast<const float*>(data));
    }
    if (!std::all_of(tensor.values.begin(), tensor.values.end(),
                     [](float v) { return std::isfinite(v); }))
      Fail("its output '" + info.name +
           "' holds NaN or infinity; check the image and the input's scale, mean and std");
    return tensor;
  }
};

Session::Session(const std::string& model_path, const InferenceOptions& options) {
  RequireRegularFile(model_path);
  if (!std::ifstream(model_path).good())
    throw Error(ErrorKind::kBadInput, {model_path},
                "this model cannot be read: check the path (docs/models.md)");
  impl_ = std::make_unique<Impl>(model_path, options);
}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

const std::string& Session::path() const { return impl_->path; }
const std::vector<TensorInfo>& Session::inputs() const { return impl_->inputs; }
const std::vector<TensorInfo>& Session::outputs() const { return impl_->outputs; }
std::string Session::Metadata(const std::string& key) const {
  const Impl& impl = *impl_;
  OrtAllocator* allocator = nullptr;
  impl.Check(impl.api.GetAllocatorWithDefaultOptions(&allocator));
  OrtModelMetadata* raw = nullptr;
  impl.Check(impl.api.SessionGetModelMetadata(impl.session.get(), &raw));
  const OrtPointer<OrtModelMetadata> metadata(raw, impl.api.ReleaseModelMetadata);
  char* value = nullptr;
  impl.Check(impl.api.ModelMetadataLookupCustomMetadataMap(raw, allocator, key.c_str(), &value));
  if (!value) return "";
  const std::string text = value;
  impl.Check(impl.api.AllocatorFree(allocator, value));
  return text;
}

InferenceOptions::Provider Session::provider() const { return impl_->provider; }

NamedTensors Session::Run(const NamedTensors& inputs) const {
  const Impl& impl = *impl_;
  std::vector<OrtPointer<OrtValue>> given, received;
  std::vector<const OrtValue*> given_raw;
  std::vector<OrtValue*> received_raw(impl.outputs.size());
  std::vector<const char*> input_names, output_names;
  for (const TensorInfo& info : impl.inputs) {
    given.push_back(impl.MakeValue(info, inputs));
    given_raw.push_back(given.back().get());
    input_names.push_back(info.name.c_str());
  }
  for (const TensorInfo& info : impl.outputs) output_names.push_back(info.name.c_str());
  impl.Check(impl.api.Run(impl.session.get(), nullptr, input_names.data(), given_raw.data(),
                          given_raw.size(), output_names.data(), output_names.size(),
                          received_raw.data()));
  for (OrtValue* value : received_raw) received.emplace_back(value, impl.api.ReleaseValue);
  NamedTensors outputs;
  for (std::size_t i = 0; i < received.size(); ++i)
    outputs[impl.outputs[i].name] = impl.ReadValue(impl.outputs[i], received[i].get());
  return outputs;
}

}  // namespace sslcd
