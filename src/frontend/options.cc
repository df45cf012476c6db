// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/options.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, VisionOptions& options) {
  visitor.Text("detector", options.detector,
               "YAML description of a 2D or 3D detector (docs/models.md); relative to the "
               "configuration file, else to the current folder");
  visitor.Text("embedder", options.embedder,
               "YAML description of a re-identification model, found as the detector is; empty: no "
               "embeddings");
  visitor.Nested("inference", options.inference, "how models are run (ONNX Runtime)");
  visitor.Section("lift", "cuboids from 2D boxes and stereo", [&](FieldVisitor& inner) {
    inner.Text("classes", options.classes,
               "YAML file of usual sizes by label (config/classes.yaml), found as the detector is; "
               "boxes of other labels are not lifted; empty: built in");
    DescribeFields(inner, options.lift);
  });
  visitor.Nested("odometry", options.odometry, "stereo odometry, where no poses are given");
  visitor.Nested("alignment", options.alignment,
                 "aligning images of different passes by the ground that both see (loop.views)");
}

}  // namespace sslcd
