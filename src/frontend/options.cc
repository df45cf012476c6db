// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/options.h"

namespace sslcd {

void DescribeFields(FieldVisitor& visitor, VisionOptions& options) {
  visitor.Everyday("another model: other classes, precision and speed")
      .Text("detector", options.detector,
            "YAML description of a 2D or 3D detector (docs/models.md); relative to the "
            "configuration file, else to the current folder; empty: boxes come from a file");
  visitor.Everyday("with one: more loops where objects look different")
      .Text("embedder", options.embedder,
            "YAML description of a re-identification model, found as the detector is; empty: no "
            "embeddings");
  visitor.Nested("inference", options.inference, "how models are run (ONNX Runtime)");
  visitor.Section("lift", "cuboids from 2D boxes and stereo", [&](FieldVisitor& inner) {
    inner.Everyday("with your own: other labels and sizes become objects")
        .Text("classes", options.classes,
              "YAML file of usual sizes by label (config/classes.yaml), found as the detector is; "
              "boxes of other labels are not lifted; empty: built in");
    DescribeFields(inner, options.lift);
  });
  visitor.Nested("odometry", options.odometry, "stereo odometry, where no poses are given");
  visitor.Nested("alignment", options.alignment,
                 "alignment of images of different passes by the ground that both show "
                 "(loop.views)");
}

std::vector<FieldProblem> Check(const VisionOptions& options) {
  VisionOptions copy = options;  // a visitor needs mutable fields
  std::vector<FieldProblem> problems = CheckRanges(
      [&copy](FieldVisitor& visitor) { visitor.Nested("vision", copy, "frames from images"); });
  if (options.lift.min_range_m > options.lift.max_range_m)
    problems.push_back({{"vision.lift.min_range_m", "vision.lift.max_range_m"},
                        "vision.lift.min_range_m is larger than vision.lift.max_range_m: no object "
                        "would be lifted"});
  return problems;
}

}  // namespace sslcd
