// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/fields.h"

namespace sslcd {

constexpr int kLargestInput = 8192;  ///< largest side of a model's input [px]

/// The preparation of an image for the model: crop rows at the top, resize to the input's size,
/// then compute `(pixel * scale - mean) / std` for each channel.
struct ModelInput {
  enum class Resize {
    kStretch,          ///< does not keep the aspect ratio
    kLetterbox,        ///< keeps the aspect ratio; centred on grey (114)
    kFitHeight,        ///< keeps the aspect ratio; cropped or black on the right
    kLetterboxCorner,  ///< keeps the aspect ratio; grey (114) on the right and below, as YOLOX
  };
  enum class Channels { kRgb, kBgr };

  std::string left, right;  ///< names of the inputs; empty: the model's first and second
  /// name of an input that takes the image input's width and height; empty: there is none
  std::string size;
  int width_px = 0, height_px = 0;  ///< size of the image input; 0: taken from the model
  int crop_top_px = 0;              ///< rows of the image cropped at the top before resizing
  Resize resize = Resize::kStretch;
  Channels channels = Channels::kRgb;
  double scale = 1. / 255;  ///< factor on the pixels' 0..255
  /// applied after `scale`, in the order of `channels`
  std::vector<double> mean{0, 0, 0}, std{1, 1, 1};
};

/// The meaning of the model's outputs; docs/models.md lists the tensors of each layout.
enum class ModelLayout {
  kYoloV5,             ///< 1 x N x (5 + classes): cx cy w h objectness scores
  kYoloV8,             ///< 1 x (4 + classes) x N: cx cy w h scores; also v11
  kYoloV10,            ///< 1 x N x 6: left top right bottom score class, without duplicates
  kBoxesScoresLabels,  ///< SSD and DETR: three outputs
  kFastestDet,         ///< 1 x (5 + classes) x H x W
  kStereo3d,           ///< VisualDet3D's Stereo3D: scores and regression of each anchor
  kMono3d,             ///< VisualDet3D's Yolo3D, used by the paper: kStereo3d from one image
  kMonoFlex,           ///< monocular: maps of centre heat, offset, depth, size and rotation
  kEmbedding,          ///< B x D, re-identification
  kYolox,              ///< 1 x N x (5 + classes): cells of strides 8, 16, 32, not decoded
};

/// Anchors of kStereo3d and kMono3d and their statistics over the training data.
struct ModelAnchors {
  double base_px = 24;                    ///< side of a square anchor of scale 1
  double stride_px = 16;                  ///< distance between two anchors
  std::vector<double> scales;             ///< factors on the side; empty: 2^(i/4), i = 0..15
  std::vector<double> ratios{0.5, 1, 2};  ///< height over width
  /// An .npy file per class number, with (scales * ratios) rows, the ratio running fastest, and the
  /// 6 columns z sin2a cos2a w h l. An anchor with a mean z <= 0 is unused: the training data has
  /// no such object.
  std::map<int, std::string> mean_files, std_files;
  /// bounds of the position of a used anchor at its mean depth, in camera axes
  double min_y_m = -0.5, max_y_m = 1.8, max_x_m = 40;
};

struct ModelOutput {
  enum class BoxFormat { kCorners, kCentre };

  ModelLayout layout = ModelLayout::kYoloV8;
  /// the model's names of the layout's tensors; empty: in the model's order
  std::map<int, std::string> names;
  int class_count = 80;  ///< number of classes of the model
  /// label by class number; other classes are dropped
  std::map<int, std::string> labels;
  double min_score = 0.4;  ///< detections with a lower score are dropped
  /// largest overlap of two boxes of one label; above it the worse box is dropped. 1: keeps all
  double nms_iou = 0.5;

  /// standard deviation of a box's sides, share of its width or height; for coarse 2D detectors
  double box_sigma = 0;

  // kBoxesScoresLabels
  BoxFormat box_format = BoxFormat::kCorners;  ///< left top right bottom, or cx cy w h
  bool normalised_boxes = false;               ///< boxes in 0..1 of the input instead of pixels

  ModelAnchors anchors;
};

/// The content of a model's YAML file.
struct ModelDescription {
  std::string name;  ///< used in messages and timing; default: the file's name without .yaml
  std::string file;  ///< path of the ONNX model; in YAML relative to the YAML file
  ModelInput input;
  ModelOutput output;
};
void DescribeFields(FieldVisitor& visitor, ModelInput& input);
void DescribeFields(FieldVisitor& visitor, ModelAnchors& anchors);
void DescribeFields(FieldVisitor& visitor, ModelOutput& output);
void DescribeFields(FieldVisitor& visitor, ModelDescription& description);

/// Reads a description. Throws the errors of LoadConfigFile (config/config.h).
ModelDescription LoadModelDescription(const std::string& yaml_path);

/// The task of a model. It determines which of Detector2d, Detector3d and Embedder loads the model.
enum class ModelTask { kDetect2d, kDetect3d, kEmbed };
ModelTask TaskOf(ModelLayout layout);

bool HasAnchors(ModelLayout layout);  ///< true for kStereo3d and kMono3d

}  // namespace sslcd
