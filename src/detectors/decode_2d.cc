// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/decode_2d.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/sigmoid.h"
#include "detectors/cells.h"

namespace sslcd {
namespace {

Box2d Centred(double cx, double cy, double width, double height) {
  return {cx - 0.5 * width, cy - 0.5 * height, cx + 0.5 * width, cy + 0.5 * height};
}

/// Collects the boxes with sufficient score and a labelled class.
class Collector {
 public:
  explicit Collector(const ModelOutput& output) : output_(output) {}

  void Add(int class_number, double score, const Box2d& box) {
    if (score >= output_.min_score && output_.labels.count(class_number))
      boxes.push_back({class_number, score, box});
  }
  /// Adds a box with its best class. The scores of the classes start at `scores`, `step` apart;
  /// `weight` is a factor on them.
  template <class Score>
  void AddBest(const float* scores, std::size_t step, const Score& weight, const Box2d& box) {
    int best = 0;
    for (int c = 1; c < output_.class_count; ++c)
      if (scores[c * step] > scores[best * step]) best = c;
    Add(best, weight(scores[best * step]), box);
  }

  std::vector<ClassBox> boxes;

 private:
  const ModelOutput& output_;
};

void DecodeYoloV5(const Tensor& tensor, Collector& found) {
  const std::size_t columns = tensor.shape[2];
  for (const float* row = tensor.values.data(); row != tensor.values.data() + tensor.values.size();
       row += columns)
    found.AddBest(
        row + 5, 1, [&](double score) { return row[4] * score; },
        Centred(row[0], row[1], row[2], row[3]));
}

void DecodeYolox(const Tensor& tensor, int width, int height, Collector& found) {
  const float* row = tensor.values.data();
  for (const int stride : kYoloxStrides) {
    for (int y = 0; y < Cells(height, stride); ++y) {
      for (int x = 0; x < Cells(width, stride); ++x, row += tensor.shape[2])
        found.AddBest(
            row + 5, 1, [&](double score) { return row[4] * score; },
            Centred((x + row[0]) * stride, (y + row[1]) * stride, std::exp(row[2]) * stride,
                    std::exp(row[3]) * stride));
    }
  }
}

void DecodeYoloV8(const Tensor& tensor, Collector& found) {
  const std::size_t count = tensor.shape[2];
  for (std::size_t i = 0; i < count; ++i) {
    const float* v = tensor.values.data() + i;
    found.AddBest(
        v + 4 * count, count, [](double score) { return score; },
        Centred(v[0], v[count], v[2 * count], v[3 * count]));
  }
}

void DecodeYoloV10(const Tensor& tensor, Collector& found) {
  for (const float* row = tensor.values.data(); row != tensor.values.data() + tensor.values.size();
       row += 6)
    found.Add(static_cast<int>(std::lround(row[5])), row[4], {row[0], row[1], row[2], row[3]});
}

void DecodeBoxesScoresLabels(const std::vector<Tensor>& outputs, const ModelOutput& output,
                             int width, int height, Collector& found) {
  const double unit_x = output.normalised_boxes ? width : 1,
               unit_y = output.normalised_boxes ? height : 1;
  const std::size_t count =
      std::min({outputs[0].values.size() / 4, outputs[1].values.size(), outputs[2].values.size()});
  for (std::size_t i = 0; i < count; ++i) {
    const float* v = outputs[0].values.data() + 4 * i;
    const double a = v[0] * unit_x, b = v[1] * unit_y, c = v[2] * unit_x, d = v[3] * unit_y;
    const Box2d box = output.box_format == ModelOutput::BoxFormat::kCentre ? Centred(a, b, c, d)
                                                                           : Box2d{a, b, c, d};
    found.Add(static_cast<int>(std::lround(outputs[2].values[i])), outputs[1].values[i], box);
  }
}

void DecodeFastestDet(const Tensor& tensor, int width, int height, Collector& found) {
  const std::size_t rows = tensor.shape[2], columns = tensor.shape[3], plane = rows * columns;
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const float* v = tensor.values.data() + y * columns + x;
      const double objectness = v[0];
      const Box2d box = Centred((x + std::tanh(v[plane])) / columns * width,
                                (y + std::tanh(v[2 * plane])) / rows * height,
                                Sigmoid(v[3 * plane]) * width, Sigmoid(v[4 * plane]) * height);
      found.AddBest(
          v + 5 * plane, plane,
          [&](double score) { return std::pow(objectness, 0.6) * std::pow(score, 0.4); }, box);
    }
  }
}

}  // namespace

std::vector<ClassBox> DecodeBoxes(const std::vector<Tensor>& outputs, const ModelOutput& output,
                                  int width, int height) {
  Collector found(output);
  switch (output.layout) {
    case ModelLayout::kYoloV5: DecodeYoloV5(outputs[0], found); break;
    case ModelLayout::kYolox: DecodeYolox(outputs[0], width, height, found); break;
    case ModelLayout::kYoloV8: DecodeYoloV8(outputs[0], found); break;
    case ModelLayout::kYoloV10: DecodeYoloV10(outputs[0], found); break;
    case ModelLayout::kBoxesScoresLabels:
      DecodeBoxesScoresLabels(outputs, output, width, height, found);
      break;
    case ModelLayout::kFastestDet: DecodeFastestDet(outputs[0], width, height, found); break;
    default: assert(!"a layout of 2D detectors");
  }
  return found.boxes;
}

std::vector<std::size_t> SuppressOverlaps(const std::vector<ClassBox>& boxes,
                                          const ModelOutput& output) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return boxes[a].score > boxes[b].score; });
  std::vector<std::size_t> kept;
  for (const std::size_t i : order) {
    const std::string& label = output.labels.at(boxes[i].class_number);
    const bool doubled = std::any_of(kept.begin(), kept.end(), [&](std::size_t better) {
      return output.labels.at(boxes[better].class_number) == label &&
             Iou(boxes[better].box, boxes[i].box) > output.nms_iou;
    });
    if (!doubled) kept.push_back(i);
  }
  return kept;
}

Box2d BoxInImage(const Box2d& box, const InputMap& map, int image_width, int image_height) {
  const Vec2 first = map.ToImage(box.left, box.top), second = map.ToImage(box.right, box.bottom);
  const double width = image_width, height = image_height;
  return {std::clamp(first.x(), 0., width), std::clamp(first.y(), 0., height),
          std::clamp(second.x(), 0., width), std::clamp(second.y(), 0., height)};
}

}  // namespace sslcd
