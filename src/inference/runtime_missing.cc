// SPDX-License-Identifier: BSD-3-Clause
// Replaces runtime.cc and session.cc if ONNX Runtime's header is not installed.
#include "inference/session.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

[[noreturn]] void Refuse() {
  throw Error(ErrorKind::kBadInput,
              "this build cannot run models: ONNX Runtime's header was not found; install it "
              "(scripts/install_deps.sh "
              "vision, or the package libonnxruntime-dev), configure and build again");
}

}  // namespace

struct Session::Impl {};
Session::Session(const std::string&, const InferenceOptions&) { Refuse(); }
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;
const std::string& Session::path() const { Refuse(); }
const std::vector<TensorInfo>& Session::inputs() const { Refuse(); }
const std::vector<TensorInfo>& Session::outputs() const { Refuse(); }
InferenceOptions::Provider Session::provider() const { Refuse(); }
NamedTensors Session::Run(const NamedTensors&) const { Refuse(); }

}  // namespace sslcd
