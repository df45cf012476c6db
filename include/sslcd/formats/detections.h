// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"

namespace SSLCD_EXPORT sslcd {

/// The meaning of the score column.
enum class ScoreKind {
  kAuto,         ///< logits if any score lies outside [0, 1], probabilities otherwise
  kProbability,  ///< in [0, 1]; anything else is an error
  kLogit,        ///< any number; becomes 1 / (1 + exp(-score))
};

struct DetectionReadOptions {
  ScoreKind score = ScoreKind::kAuto;
};
void DescribeFields(FieldVisitor& visitor, DetectionReadOptions& options);

/// The supported row formats. The columns of the first row determine the format.
enum class DetectionFormat {
  kNone,  ///< the file has no rows
  /// label trunc occl alpha box4 h w l x y z ry [score]; one file per frame: %06d.txt
  kKittiObject,
  kKittiTracking,  ///< frame id label trunc occl alpha box4 h w l x y z ry [score]
  kAb3dmotCsv,     ///< frame,type(1 Pedestrian 2 Car 3 Cyclist),box4,score,h,w,l,x,y,z,ry,alpha
};
const char* ToString(DetectionFormat format);

/// Columns of a row as they are in the file, where reading changes or leaves out what they say.
struct DetectionColumns {
  int frame = 0;
  double alpha = 0, rotation_y = 0, score = 1;
  Box2d box;  ///< any four numbers
};

/// Detections of a whole sequence. Every non-blank line has a row number, including the lines that
/// are left out.
struct DetectionFile {
  DetectionFormat format = DetectionFormat::kNone;
  /// detections by frame number, in file order; frames without detections have no entry
  std::map<int, std::vector<Detection>> by_frame;
  int rows = 0;         ///< rows read: kept + dont_care + dropped
  int dont_care = 0;    ///< rows of class DontCare, left out
  int dropped = 0;      ///< rows with NaN, infinities, or sizes that are not positive, left out
  bool logits = false;  ///< the scores were logits
  std::vector<DetectionColumns> columns;  ///< of all rows, by row number
  std::vector<std::string> warnings;
};

/// Reads a file, or a folder of %06d.txt (object layout, the name is the frame number). Frames may
/// come in any order. KITTI's bottom-face centre and rotation_y become T_cam_object of the cuboid's
/// centre. A 2D box without area (-1 -1 -1 -1) becomes std::nullopt. Without a score column the
/// scores are 1. Throws Error with file:line for malformed rows: a wrong or varying number of
/// columns, a malformed number, a negative frame, an unknown class number, or a score outside [0,
/// 1] with ScoreKind::kProbability.
DetectionFile ReadDetections(const std::string& path, const DetectionReadOptions& options = {});

/// Rows of DetectionFormat::kKittiTracking with a score; id, truncated and occluded are -1.
std::string DetectionsText(const std::vector<std::vector<Detection>>& by_frame);

}  // namespace sslcd
