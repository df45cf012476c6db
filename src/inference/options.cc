// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/inference/session.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, InferenceOptions& options) {
  visitor.Text("library", options.library,
               "path of libonnxruntime.so, relative as a detector's; empty: environment "
               "SSLCD_ORT_LIB, else the usual places");
  visitor.Enum("provider", options.provider, {"cpu", "cuda"},
               "what models run on; the CPU where CUDA is not there");
  visitor.Integer("device_id", options.device_id, 0, 255, "which GPU");
  visitor.Integer("threads", options.threads, 1, 256, "threads of one model; 1: the caller's only");
  visitor.Flag("warm_up", options.warm_up, "run once on an empty image when loading");
}

}  // namespace sslcd
