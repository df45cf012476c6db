// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/model_description.h"

#include <cmath>
#include <filesystem>

#include "sslcd/config/config.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// Checks that the ranges of single fields do not cover.
void Check(const ModelDescription& model, const std::string& path) {
  const auto refuse = [&path](const std::string& message) {
    throw Error(ErrorKind::kBadConfig, {path}, message);
  };
  if (model.file.empty())
    refuse("'file' is missing: the path of the ONNX model, relative to this file");
  if (model.input.mean.size() != 3 || model.input.std.size() != 3)
    refuse("'mean' and 'std' in 'input' need three numbers each, one a channel");
  const ModelOutput& output = model.output;
  if (TaskOf(output.layout) == ModelTask::kEmbed) return;
  if (output.labels.empty())
    refuse(
        "'labels' in 'output' is missing: which classes are wanted and what they are called, e.g. "
        "{2: Car}");
  for (const auto& [number, label] : output.labels) {
    if (label.empty() || label.find_first_of(" \t\r\n,") != std::string::npos)
      refuse("'labels' calls class " + std::to_string(number) + " '" + label +
             "': a label is one word without commas, e.g. TrafficLight");
    if (output.layout != ModelLayout::kBoxesScoresLabels &&
        output.layout != ModelLayout::kYoloV10 && number >= output.class_count)
      refuse("'labels' has class " + std::to_string(number) + ", but 'class_count' is " +
             std::to_string(output.class_count));
    if (HasAnchors(output.layout) &&
        (!output.anchors.mean_files.count(number) || !output.anchors.std_files.count(number)))
      refuse("'anchors' needs a file in 'mean_files' and in 'std_files' for class " +
             std::to_string(number));
  }
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, ModelInput& input) {
  visitor.Text("left", input.left,
               "name of the input that takes the (left) image; empty: the model's first");
  visitor.Text("right", input.right,
               "name of the input that takes the right image; empty: the model's second");
  visitor.Text("size", input.size,
               "name of an input that asks for the input's width and height; empty: there is none");
  visitor.Integer("width_px", input.width_px, 0, kLargestInput,
                  "width of the input; 0: what the model says");
  visitor.Integer("height_px", input.height_px, 0, kLargestInput,
                  "height of the input; 0: what the model says");
  visitor.Integer("crop_top_px", input.crop_top_px, 0, kLargestInput,
                  "rows of the image cut off before resizing");
  visitor.Enum("resize", input.resize, {"stretch", "letterbox", "fit_height", "letterbox_corner"},
               "how an image gets the input's size");
  visitor.Enum("channels", input.channels, {"rgb", "bgr"}, "order of the colours");
  visitor.Real("scale", input.scale, 1e-6, 1e3, "factor on the pixels' 0..255");
  visitor.Numbers("mean", input.mean, -1e3, 1e3, "subtracted from each channel, after scale");
  visitor.Numbers("std", input.std, 1e-6, 1e3, "each channel is divided by it");
}

void DescribeFields(FieldVisitor& visitor, ModelAnchors& anchors) {
  visitor.Real("base_px", anchors.base_px, 1, 1e3, "side of a square anchor of scale 1");
  visitor.Real("stride_px", anchors.stride_px, 1, 1e3, "from one anchor to the next");
  visitor.Numbers("scales", anchors.scales, 1e-3, 1e3, "of the side; left out: 2^(i/4), i = 0..15");
  visitor.Numbers("ratios", anchors.ratios, 1e-3, 1e3, "height over width");
  visitor.Names("mean_files", anchors.mean_files,
                "class number -> .npy with mean z sin2a cos2a w h l of each anchor");
  visitor.Names("std_files", anchors.std_files,
                "class number -> .npy with their standard deviations");
  visitor.Real("min_y_m", anchors.min_y_m, -1e3, 1e3,
               "anchors higher than that over the camera's axis are left out");
  visitor.Real("max_y_m", anchors.max_y_m, -1e3, 1e3,
               "anchors lower than that under the camera's axis are left out");
  visitor.Real("max_x_m", anchors.max_x_m, 0, 1e3, "anchors farther to the side are left out");
}

void DescribeFields(FieldVisitor& visitor, ModelOutput& output) {
  visitor.Enum("layout", output.layout,
               {"yolo_v5", "yolo_v8", "yolo_v10", "boxes_scores_labels", "fastestdet", "stereo3d",
                "mono3d", "monoflex", "embedding", "yolox"},
               "what the model's numbers mean");
  visitor.Names("names", output.names,
                "the model's names for the layout's tensors; left out: in the model's order");
  visitor.Integer("class_count", output.class_count, 1, 100000,
                  "how many classes the model tells apart");
  visitor.Names("labels", output.labels,
                "class number -> label; classes that are not listed are dropped");
  visitor.Real("min_score", output.min_score, 0, 1, "detections with a lower score are dropped");
  visitor.Real("nms_iou", output.nms_iou, 0, 1,
               "of two boxes of one label that overlap more, the better one stays");
  visitor.Real("box_sigma", output.box_sigma, 0, 1,
               "2D detectors: standard deviation of a box's sides, share of its width or height");
  visitor.Enum("box_format", output.box_format, {"corners", "centre"},
               "boxes_scores_labels: what a box's numbers are");
  visitor.Flag("normalised_boxes", output.normalised_boxes,
               "boxes_scores_labels: boxes in 0..1 instead of pixels");
  visitor.Nested("anchors", output.anchors,
                 "stereo3d, mono3d: anchors and what is known about them");
}

void DescribeFields(FieldVisitor& visitor, ModelDescription& description) {
  visitor.Text("name", description.name, "in messages and timing; empty: this file's name");
  visitor.Text("file", description.file, "path of the ONNX model, relative to this file");
  visitor.Nested("input", description.input, "how an image becomes the model's input");
  visitor.Nested("output", description.output, "what the model's numbers mean");
}

ModelDescription LoadModelDescription(const std::string& yaml_path) {
  const std::filesystem::path path(yaml_path);
  if (path.extension() == ".onnx")
    throw Error(ErrorKind::kBadConfig, {yaml_path},
                "is a model, and a description is needed that says what its numbers mean: "
                "'sslcd_run model inspect " +
                    yaml_path + " --out " + path.stem().string() +
                    ".yaml' writes one (docs/models.md)");
  ModelDescription model;
  LoadConfigFile(yaml_path, [&model](FieldVisitor& visitor) { DescribeFields(visitor, model); });
  Check(model, yaml_path);
  const auto resolve = [&path](std::string& file) { file = (path.parent_path() / file).string(); };
  if (model.name.empty()) model.name = path.stem().string();
  resolve(model.file);
  ModelAnchors& anchors = model.output.anchors;
  for (auto* files : {&anchors.mean_files, &anchors.std_files})
    for (auto& [number, file] : *files) resolve(file);
  if (anchors.scales.empty())
    for (int i = 0; i < 16; ++i) anchors.scales.push_back(std::exp2(i / 4.));
  return model;
}

ModelTask TaskOf(ModelLayout layout) {
  switch (layout) {
    case ModelLayout::kEmbedding: return ModelTask::kEmbed;
    case ModelLayout::kStereo3d:
    case ModelLayout::kMono3d:
    case ModelLayout::kMonoFlex: return ModelTask::kDetect3d;
    default: return ModelTask::kDetect2d;
  }
}

bool HasAnchors(ModelLayout layout) {
  return layout == ModelLayout::kStereo3d || layout == ModelLayout::kMono3d;
}

}  // namespace sslcd
