// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "detectors/prepare.h"
#include "inference/tensor.h"

namespace sslcd {

/// A box of a model's output: in pixels of its input, with a class number.
struct ClassBox {
  int class_number = 0;
  double score = 0;
  Box2d box;
};

/// Decodes the boxes of a model's outputs whose score is at least `output.min_score` and whose
/// class has a label. The outputs have the order and shapes of the layout. `width` x `height` is
/// the size of the input.
///
/// Layouts: ultralytics' YOLO v5 (score = objectness x class), v8 and v11, v10; YOLOX (Ge et al.,
/// 2021: score as v5, centre = (cell + offset) * stride, size = exp * stride); FastestDet (score =
/// objectness^0.6 x class^0.4, centre = cell + tanh, size = sigmoid); boxes, scores, labels.
std::vector<ClassBox> DecodeBoxes(const std::vector<Tensor>& outputs, const ModelOutput& output,
                                  int width, int height);

/// Non-maximum suppression: returns the indices of the boxes that overlap no better box of the same
/// label by more than `nms_iou`. Best score first; equal scores keep their order.
std::vector<std::size_t> SuppressOverlaps(const std::vector<ClassBox>& boxes,
                                          const ModelOutput& output);

/// Maps a box from the input to the image and clips it.
Box2d BoxInImage(const Box2d& box, const InputMap& map, int image_width, int image_height);

}  // namespace sslcd
