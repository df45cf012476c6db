// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/inference/options.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, InferenceOptions& options) {
  visitor.Text("library", options.library,
               "path of libonnxruntime.so, found as the detector is; empty: environment "
               "SSLCD_ORT_LIB, else the usual places");
  visitor.Everyday("cuda: faster with a GPU")
      .Enum("provider", options.provider, {"cpu", "cuda"},
            "device that models run on; the CPU where there is no CUDA");
  visitor.Integer("device_id", options.device_id, 0, 255, "number of the GPU");
  visitor.Integer("threads", options.threads, 1, 256,
                  "threads of one model; 1: the calling thread alone");
}

}  // namespace sslcd
