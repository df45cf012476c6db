// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/kitti_ground_truth.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/landmark.h"

namespace sslcd {

/// A run on a KITTI tracking sequence and what it is judged against. Poses are T_world_cam, indexed
/// by frame number.
struct MapRun {
  std::vector<Pose> estimate;
  /// the final map, in the estimate's world; only confirmed ones count
  std::vector<MapObject> objects;
  /// the detections as they went in: frame number, boxes, scores and rows are used
  std::vector<Frame> frames;
  std::vector<Pose> reference;        ///< true poses
  std::vector<GroundTruthBox> truth;  ///< annotated boxes of the sequence
};

struct MapMetricOptions {
  /// A detection counts as raw result from this score on. Scores are probabilities: a threshold on
  /// a detector's raw (logit) score goes through Sigmoid(). The default belongs to the raw score 3.
  double min_score = 0.9525741268224334;
  std::vector<std::string> labels{"Car", "Van"};  ///< annotated classes that count
  /// a track that extends less than this in the reference world is static
  double static_below_m = 2.;
  double driving_above_m = 5.;   ///< one that extends more is driving
  double box_gate_m = 2.5;       ///< horizontal; annotated box - detection or map object
  double identity_gate_m = 1.5;  ///< horizontal; detection - annotated box whose identity it takes
  int min_sightings = 5;         ///< detections a track needs to be counted as an object to find
};

/// Accuracy, completeness and identities of a map. Boxes are compared in the camera frame, upright
/// in it.
struct MapMetrics {
  /// mean 3D IoU of the frames' own detections, over static objects
  std::optional<double> iou_raw;
  /// the same over the (frame, object) pairs that the map has, too
  std::optional<double> iou_raw_same_pairs;
  /// mean 3D IoU of the map's cuboids seen from the estimated poses
  std::optional<double> iou_map;
  int pairs = 0;        ///< (frame, static object) pairs with a detection
  double coverage = 0;  ///< part of them for which the map has an object, too
  int landmarks = 0;    ///< confirmed objects of the map
  /// part of the observations that belong to their landmark's most frequent identity
  double purity = 0;
  int static_objects = 0;           ///< static identities that were detected often enough
  double static_found = 0;          ///< part of them that own a landmark
  double landmarks_per_static = 0;  ///< landmarks per static identity that owns one
  double driving_in_map = 0;        ///< part of the driving identities that own a landmark
};

/// Throws Error (kUsage) when two frames carry the same number or an annotated box a negative one.
MapMetrics ComputeMapMetrics(const MapRun& run, const MapMetricOptions& options = {});

}  // namespace sslcd
