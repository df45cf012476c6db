// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/options.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, VisionOptions& options) {
  visitor.Text("detector", options.detector,
               "YAML description of a 2D or 3D detector; relative to the configuration file, else "
               "to the current folder");
  visitor.Text("embedder", options.embedder,
               "YAML description of a re-identification model, likewise; empty: no embeddings");
  visitor.Nested("inference", options.inference, "how models are run (ONNX Runtime)");
  visitor.Nested("lift", options.lift, "cuboids from 2D boxes and stereo");
  visitor.Nested("odometry", options.odometry, "stereo odometry, where no other is given");
  visitor.Nested("alignment", options.alignment,
                 "images of different passes by the ground both see (loop.views)");
  visitor.Integer("ahead", options.ahead, 1, 1000,
                  "frames that wait between two stages that run at the same time");
}

}  // namespace sslcd
