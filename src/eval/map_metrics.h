// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/kitti_ground_truth.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/landmark.h"

namespace sslcd {

/// A run on a KITTI tracking sequence and its ground truth. Poses are T_world_cam, indexed by frame
/// number.
struct MapRun {
  std::vector<Pose> estimate;
  /// the final map, in the estimate's world; only confirmed ones count
  std::vector<MapObject> objects;
  /// the input detections: frame number, boxes, scores and rows are used
  std::vector<Frame> frames;
  std::vector<Pose> reference;        ///< true poses
  std::vector<GroundTruthBox> truth;  ///< annotated boxes of the sequence
};

struct MapMetricOptions {
  /// Smallest score of a raw detection that counts [probability]. Sigmoid() converts a detector's
  /// raw (logit) score; the default is Sigmoid(3).
  double min_score = 0.9525741268224334;
  std::vector<std::string> labels{"Car", "Van"};  ///< annotated classes that count
  /// a track whose positions extend less than this in the reference world is static
  double static_below_m = 2.;
  double driving_above_m = 5.;  ///< a track that extends more than this is driving
  /// largest horizontal distance of an annotated box from its detection or map object
  double box_gate_m = 2.5;
  /// largest horizontal distance of a detection from the annotated box whose identity it takes
  double identity_gate_m = 1.5;
  int min_sightings = 5;  ///< a track with fewer detections is not an object to find
};

/// Accuracy, completeness and identities of a map. Boxes are compared in the camera frame, upright
/// in it.
struct MapMetrics {
  /// mean 3D IoU of the frames' own detections, over static objects
  std::optional<double> iou_raw;
  /// the same over the (frame, object) pairs that the map covers
  std::optional<double> iou_raw_same_pairs;
  /// mean 3D IoU of the map's cuboids seen from the estimated poses
  std::optional<double> iou_map;
  int pairs = 0;        ///< (frame, static object) pairs with a detection
  double coverage = 0;  ///< share of these pairs for which the map has an object
  int landmarks = 0;    ///< confirmed objects of the map
  /// share of the observations that belong to their landmark's most frequent identity
  double purity = 0;
  int static_objects = 0;           ///< static identities that were detected often enough
  double static_found = 0;          ///< share of them that own a landmark
  double landmarks_per_static = 0;  ///< landmarks per static identity that owns one
  double driving_in_map = 0;        ///< share of the driving identities that own a landmark
};

/// Throws Error (kUsage) when two frames carry the same number or an annotated box a negative one.
MapMetrics ComputeMapMetrics(const MapRun& run, const MapMetricOptions& options = {});

}  // namespace sslcd
