// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/fields.h"

namespace sslcd {

/// What the score column holds.
enum class ScoreKind {
  kAuto,         ///< logits if any score lies outside [0, 1], probabilities otherwise
  kProbability,  ///< in [0, 1]; anything else is an error
  kLogit,        ///< any number; becomes 1 / (1 + exp(-score))
};

struct DetectionReadOptions {
  ScoreKind score = ScoreKind::kAuto;
};
void DescribeFields(FieldVisitor& visitor, DetectionReadOptions& options);

/// The layouts read; told by the columns of the first row.
enum class DetectionFormat {
  kNone,         ///< no row at all
  kKittiObject,  ///< label trunc occl alpha box4 h w l x y z ry [score]; one file a frame: %06d.txt
  kKittiTracking,  ///< frame id label trunc occl alpha box4 h w l x y z ry [score]
  kAb3dmotCsv,     ///< frame,type(1 Pedestrian 2 Car 3 Cyclist),box4,score,h,w,l,x,y,z,ry,alpha
};
const char* ToString(DetectionFormat format);

/// Detections of a whole sequence. Every non-blank line has a row number, also those left out.
struct DetectionFile {
  DetectionFormat format = DetectionFormat::kNone;
  /// frame number -> its detections in file order; none: not listed
  std::map<int, std::vector<Detection>> by_frame;
  int rows = 0;         ///< rows read: kept + dont_care + dropped
  int dont_care = 0;    ///< rows of class DontCare, left out
  int dropped = 0;      ///< rows with NaN, infinities, or sizes that are not positive, left out
  bool logits = false;  ///< the scores were logits
  std::vector<std::string> warnings;
};

/// Reads a file, or a folder of %06d.txt (object layout, the name is the frame number). Frames may
/// come in any order. KITTI's bottom-face centre and rotation_y become T_cam_object of the cuboid's
/// centre; a 2D box without area
/// (-1 -1 -1 -1) becomes none; no score column means score 1.
/// Throws Error with file:line for malformed rows: wrong or varying number of columns, a letter in
/// a number, a negative frame, an unknown class number, a score that is no probability where
/// ScoreKind::kProbability is asked for.
DetectionFile ReadDetections(const std::string& path, const DetectionReadOptions& options = {});

/// Rows of DetectionFormat::kKittiTracking with a score; id, truncated and occluded are -1.
std::string DetectionsText(const std::vector<std::vector<Detection>>& by_frame);

}  // namespace sslcd
