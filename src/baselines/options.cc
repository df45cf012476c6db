// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/options.h"

namespace sslcd::baselines {

void DescribeFields(FieldVisitor& visitor, BaselineOptions& options) {
  visitor.Nested("lin", options.lin, "Lin et al. 2021: random walks and edit distance");
  visitor.Nested("x_view", options.x_view, "Gawel et al. 2018: random walks");
  visitor.Nested("semantic_histogram", options.semantic_histogram,
                 "Guo et al. 2021: histograms of label paths");
  visitor.Nested("appearance", options.appearance,
                 "a bag of binary words and PnP, as in DBoW2 and VINS-Fusion");
  visitor.Nested("point_matches", options.point_matches, "matched image points, e.g. SuperGlue's");
}

}  // namespace sslcd::baselines
