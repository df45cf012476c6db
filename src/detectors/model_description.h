// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/fields.h"

namespace sslcd {

/// How an image becomes the model's input: rows are cut off on top, the rest is brought to the
/// input's size, then
/// `(pixel * scale - mean) / std` for each channel.
struct ModelInput {
  enum class Resize {
    kStretch,    ///< to the input's size, whatever becomes of the aspect ratio
    kLetterbox,  ///< keeps the aspect ratio; in the middle of grey (114)
    kFitHeight,  ///< keeps the aspect ratio; cut off or black on the right
  };
  enum class Channels { kRgb, kBgr };

  std::string left, right;  ///< names of the inputs; empty: the model's first and second
  /// name of an input that asks for the input's width and height; empty: there is none
  std::string size;
  int width_px = 0, height_px = 0;  ///< 0: what the model says
  int crop_top_px = 0;              ///< rows of the image cut off before resizing
  Resize resize = Resize::kStretch;
  Channels channels = Channels::kRgb;
  double scale = 1. / 255;                          ///< factor on the pixels' 0..255
  std::vector<double> mean{0, 0, 0}, std{1, 1, 1};  ///< after `scale`, in the order of `channels`
};

/// What the model's numbers mean; docs/models.md has each layout's tensors.
enum class ModelLayout {
  kYoloV5,             ///< 1 x N x (5 + classes): cx cy w h objectness scores
  kYoloV8,             ///< 1 x (4 + classes) x N: cx cy w h scores; also v11
  kYoloV10,            ///< 1 x N x 6: left top right bottom score class, without duplicates
  kBoxesScoresLabels,  ///< SSD and DETR: three outputs
  kFastestDet,         ///< 1 x (5 + classes) x H x W
  kStereo3d,           ///< VisualDet3D's Stereo3D: scores and regression of each anchor
  kMono3d,             ///< VisualDet3D's Yolo3D, the paper's: the same from one image
  kMonoFlex,           ///< monocular: maps of heat, offset, depth, size and rotation
  kEmbedding,          ///< B x D, re-identification
};

/// Anchors of kStereo3d and kMono3d, and what the training data says about them.
struct ModelAnchors {
  double base_px = 24;                    ///< side of a square anchor of scale 1
  double stride_px = 16;                  ///< from one anchor to the next
  std::vector<double> scales;             ///< of the side; empty: 2^(i/4), i = 0..15
  std::vector<double> ratios{0.5, 1, 2};  ///< height over width
  /// For each class: .npy of (scales * ratios) rows, the ratio running fastest, and 6 columns: z
  /// sin2a cos2a w h l. Mean z <= 0: no object like that was seen, the anchor is not used.
  std::map<int, std::string> mean_files, std_files;
  /// where an anchor at its mean depth is worth a look
  double min_y_m = -0.5, max_y_m = 1.8, max_x_m = 40;
};

struct ModelOutput {
  enum class BoxFormat { kCorners, kCentre };

  ModelLayout layout = ModelLayout::kYoloV8;
  /// the model's names for the layout's tensors; not there: in the model's order
  std::map<int, std::string> names;
  int class_count = 80;  ///< how many classes the model tells apart
  /// class number -> label; classes that are not listed are dropped
  std::map<int, std::string> labels;
  double min_score = 0.4;  ///< detections with a lower score are dropped
  /// of two boxes of one label that overlap more, the better one stays; 1: both
  double nms_iou = 0.5;

  /// error of a box's sides, share of its width or height: coarse 2D detectors
  double box_sigma = 0;

  // kBoxesScoresLabels
  BoxFormat box_format = BoxFormat::kCorners;  ///< left top right bottom, or cx cy w h
  bool normalised_boxes = false;               ///< in 0..1 of the input instead of pixels

  ModelAnchors anchors;
};

/// A model as its YAML file describes it.
struct ModelDescription {
  std::string name;  ///< in messages and timing; default: the file's name without .yaml
  std::string file;  ///< path of the ONNX model; in YAML relative to the YAML file
  ModelInput input;
  ModelOutput output;
};
void DescribeFields(FieldVisitor& visitor, ModelInput& input);
void DescribeFields(FieldVisitor& visitor, ModelAnchors& anchors);
void DescribeFields(FieldVisitor& visitor, ModelOutput& output);
void DescribeFields(FieldVisitor& visitor, ModelDescription& description);

/// Reads a description; strict like all our configuration (config/config.h).
ModelDescription LoadModelDescription(const std::string& yaml_path);

/// What a model of this layout is for: decides which of Detector2d, Detector3d and Embedder can
/// load it.
enum class ModelTask { kDetect2d, kDetect3d, kEmbed };
ModelTask TaskOf(ModelLayout layout);

bool HasAnchors(ModelLayout layout);  ///< kStereo3d, kMono3d

}  // namespace sslcd
