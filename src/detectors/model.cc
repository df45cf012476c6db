// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/model.h"

#include <algorithm>
#include <cmath>

#include "detectors/cells.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

const char* ClassFor(ModelTask task) {
  return task == ModelTask::kDetect2d   ? "Detector2d"
         : task == ModelTask::kDetect3d ? "Detector3d"
                                        : "Embedder";
}

/// Reads the description before the session, which needs it.
ModelDescription LoadFor(ModelTask task, const std::string& yaml_path) {
  ModelDescription description = LoadModelDescription(yaml_path);
  const ModelTask found = TaskOf(description.output.layout);
  if (found != task)
    throw Error(
        ErrorKind::kBadConfig, {yaml_path},
        std::string("its layout is for ") + ClassFor(found) + ", not for " + ClassFor(task));
  return description;
}

/// Some exports omit a batch dimension of one.
bool FitsWithOrWithoutBatch(const TensorShape& shape, const TensorShape& expected) {
  return Fits(shape, expected) || (expected.size() > 1 && expected[0] == 1 &&
                                   Fits(shape, TensorShape(expected.begin() + 1, expected.end())));
}

}  // namespace

std::vector<TensorShape> LayoutShapes(const ModelOutput& output, int width, int height) {
  const std::int64_t classes = output.class_count;
  switch (output.layout) {
    case ModelLayout::kYoloV5: return {{1, -1, 5 + classes}};
    case ModelLayout::kYolox: return {{1, CellCount(width, height, kYoloxStrides), 5 + classes}};
    case ModelLayout::kYoloV8: return {{1, 4 + classes, -1}};
    case ModelLayout::kYoloV10: return {{1, -1, 6}};
    case ModelLayout::kBoxesScoresLabels: return {{1, -1, 4}, {1, -1}, {1, -1}};
    case ModelLayout::kFastestDet: return {{1, 5 + classes, -1, -1}};
    case ModelLayout::kStereo3d:
    case ModelLayout::kMono3d: {
      const ModelAnchors& anchors = output.anchors;
      const auto cells = [&](int size) {
        return static_cast<std::int64_t>(std::ceil(size / anchors.stride_px));
      };
      const auto per_cell =
          static_cast<std::int64_t>(anchors.scales.size() * anchors.ratios.size());
      const std::int64_t count = cells(width) * cells(height) * per_cell;
      return {{1, count, classes + 1}, {1, count, 12}};
    }
    case ModelLayout::kMonoFlex:
      return {
          {1, classes, -1, -1}, {1, 2, -1, -1}, {1, 1, -1, -1}, {1, 3, -1, -1}, {1, -1, -1, -1}};
    case ModelLayout::kEmbedding: return {{-1, -1}};
  }
  return {};
}

Model::Model(const std::string& yaml_path, ModelTask task, const InferenceOptions& options)
    : yaml_path_(yaml_path),
      description_(LoadFor(task, yaml_path)),
      session_(description_.file, options) {
  ReadInputs();
  ReadOutputs();
  // Runs once on an empty image, so that the first frame is not slower than the others.
  Tensor empty = EmptyInput(1);
  Run(empty, takes_two_images() ? std::optional<Tensor>(empty) : std::nullopt);
}

void Model::Refuse(const std::string& message) const {
  throw Error(ErrorKind::kBadConfig, {yaml_path_},
              message + " (" + session_.path() + "); docs/models.md");
}

const TensorInfo& Model::InputNamed(const std::string& name, std::size_t position) const {
  const std::vector<TensorInfo>& inputs = session_.inputs();
  if (name.empty() && position < inputs.size()) return inputs[position];
  std::string known;
  for (const TensorInfo& info : inputs) {
    if (info.name == name) return info;
    known += (known.empty() ? "'" : ", '") + info.name + "'";
  }
  Refuse(name.empty() ? "the layout needs " + std::to_string(position + 1) +
                            " inputs, the model has only " + known
                      : "the model has no input '" + name + "', only " + known);
}

void Model::ReadInputs() {
  const ModelInput& input = description_.input;
  const TensorInfo& left = InputNamed(input.left, 0);
  const TensorShape& shape = left.shape;
  const auto or_any = [](int size) { return static_cast<std::int64_t>(size > 0 ? size : -1); };
  const TensorShape wanted{-1, 3, or_any(input.height_px), or_any(input.width_px)};
  if (!Fits(shape, wanted))
    Refuse("input '" + left.name + "' of the model is " + ToString(shape) +
           ", the description has " + ToString(wanted));
  left_name_ = left.name;
  fixed_batch_ = static_cast<int>(std::max<std::int64_t>(shape[0], 0));
  height_ = input.height_px > 0 ? input.height_px : static_cast<int>(shape[2]);
  width_ = input.width_px > 0 ? input.width_px : static_cast<int>(shape[3]);
  if (height_ <= 0 || width_ <= 0)
    Refuse("input '" + left.name + "' of the model takes any size (" + ToString(shape) +
           "): give 'width_px' and 'height_px' in 'input'");
  std::size_t used = 1;
  if (takes_two_images()) {
    const TensorInfo& right = InputNamed(input.right, 1);
    if (!Fits(right.shape, {shape[0], 3, height_, width_}))
      Refuse("input '" + right.name + "' of the model is " + ToString(right.shape) + ", '" +
             left.name + "' " + ToString(shape));
    right_name_ = right.name;
    ++used;
  }
  if (!input.size.empty()) {
    const TensorInfo& size = InputNamed(input.size, used);
    if (!Fits(size.shape, {-1, 2}))
      Refuse("input '" + size.name + "' of the model is " + ToString(size.shape) +
             ", width and height are 1x2");
    ++used;
  }
  if (session_.inputs().size() != used)
    Refuse("the model has " + std::to_string(session_.inputs().size()) +
           " inputs, the description fills " + std::to_string(used));
}

void Model::ReadOutputs() {
  const ModelOutput& output = description_.output;
  output_shapes_ = LayoutShapes(output, width_, height_);
  const std::vector<TensorInfo>& outputs = session_.outputs();
  for (std::size_t i = 0; i < output_shapes_.size(); ++i) {
    const auto named = output.names.find(static_cast<int>(i));
    const auto found = std::find_if(outputs.begin(), outputs.end(), [&](const TensorInfo& info) {
      return named == output.names.end() ? &info == outputs.data() + i : info.name == named->second;
    });
    if (found == outputs.end()) {
      std::string known;
      for (const TensorInfo& info : outputs)
        known += (known.empty() ? "'" : ", '") + info.name + "'";
      Refuse("the model has no output " +
             (named == output.names.end() ? std::to_string(i) : "'" + named->second + "'") +
             ", only " + known);
    }
    if (!FitsWithOrWithoutBatch(found->shape, output_shapes_[i]))
      Refuse("output '" + found->name + "' of the model is " + ToString(found->shape) +
             ", the layout expects " + ToString(output_shapes_[i]));
    output_names_.push_back(found->name);
  }
}

Tensor Model::EmptyInput(int batch) const {
  Tensor tensor{{fixed_batch_ > 0 ? fixed_batch_ : batch, 3, height_, width_}, {}};
  tensor.values.resize(ElementCount(tensor.shape));
  return tensor;
}

std::vector<Tensor> Model::Run(Tensor left, std::optional<Tensor> right) const {
  NamedTensors inputs;
  if (!description_.input.size.empty())
    inputs[description_.input.size] = {{1, 2},
                                       {static_cast<float>(width_), static_cast<float>(height_)}};
  inputs[left_name_] = std::move(left);
  if (right) inputs[right_name_] = std::move(*right);
  NamedTensors outputs = session_.Run(inputs);
  std::vector<Tensor> ordered;
  for (std::size_t i = 0; i < output_names_.size(); ++i) {
    Tensor& tensor = outputs.at(output_names_[i]);
    const TensorShape& expected = output_shapes_[i];
    if (!FitsWithOrWithoutBatch(tensor.shape, expected))
      Refuse("output '" + output_names_[i] + "' is " + ToString(tensor.shape) +
             ", the layout expects " + ToString(expected));
    if (tensor.shape.size() < expected.size()) tensor.shape.insert(tensor.shape.begin(), 1);
    ordered.push_back(std::move(tensor));
  }
  return ordered;
}

std::optional<ScopedTimer> Model::Time(TimingTable* timing, const char* stage) const {
  using Timer = std::optional<ScopedTimer>;
  return timing ? Timer(std::in_place, *timing, description_.name + " " + stage) : Timer();
}

}  // namespace sslcd
