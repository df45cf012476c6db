// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "detectors/prepare.h"
#include "inference/tensor.h"

namespace sslcd {

/// A box as the model says it: in pixels of its input, by the number of its class.
struct ClassBox {
  int class_number = 0;
  double score = 0;
  Box2d box;
};

/// The boxes in a model's outputs, in the layout's order and with its shapes, whose score is at
/// least `output.min_score` and whose class has a label. `width` x `height` is the size of the
/// input.
///
/// Layouts: ultralytics' YOLO v5 (score = objectness x class), v8 and v11, v10; FastestDet (score =
/// objectness^0.6 x class^0.4, centre = cell + tanh, size = sigmoid); boxes, scores, labels.
std::vector<ClassBox> DecodeBoxes(const std::vector<Tensor>& outputs, const ModelOutput& output,
                                  int width, int height);

/// Which boxes stay when those that overlap a better one of the same label by more than `nms_iou`
/// go. Best score first; equal scores keep their order.
std::vector<std::size_t> SuppressOverlaps(const std::vector<ClassBox>& boxes,
                                          const ModelOutput& output);

/// A box of the input as one of the image, clipped to it.
Box2d BoxInImage(const Box2d& box, const InputMap& map, int image_width, int image_height);

}  // namespace sslcd
