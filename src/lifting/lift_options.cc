// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/lifting/lift.h"

namespace sslcd {

std::map<std::string, ClassPrior> UsualClasses() {
  // Usual sizes on European roads; the car's are those of the 307 labelled cars of KITTI tracking.
  return {{"Car", {3.93, 1.63, 1.53, 0.44, 0.11, 0.13, 0.18, 0.5}},
          {"Van", {5.1, 1.95, 2.1, 0.6, 0.12, 0.25, 0.16, 0.8}},
          {"Truck", {7, 2.4, 3, 2, 0.2, 0.4, 0.16, 0.95}},
          {"Bus", {11, 2.55, 3.2, 2, 0.1, 0.4, 0.16, 0.98}},
          {"Pedestrian", {0.7, 0.6, 1.75, 0.2, 0.15, 0.12, 0, 0.6}},
          {"Cyclist", {1.75, 0.6, 1.75, 0.15, 0.12, 0.12, 0.2, 0.3}}};
}

DetectionNoise LiftNoise() {
  DetectionNoise noise;
  // Larger than the errors of single cuboids: errors correlate while an object is passed, and
  // errors of height correlate over all objects of a frame.
  noise.radial_m = 0.03;
  noise.radial_per_m = 0.045;
  noise.lateral_m = 0.2;
  noise.lateral_per_m = 0.002;
  noise.vertical_m = 0.2;
  noise.vertical_per_m = 0.0005;
  noise.yaw_rad = 0.06;
  noise.yaw_per_m = 0.018;
  noise.size_relative = 0.1;
  noise.initial_scale = 1;
  return noise;
}

void DescribeFields(FieldVisitor& visitor, ClassPrior& prior) {
  visitor.Real("length_m", prior.length_m, 0.05, 50, "usual length");
  visitor.Real("width_m", prior.width_m, 0.05, 50, "usual width");
  visitor.Real("height_m", prior.height_m, 0.05, 50, "usual height");
  visitor.Real("length_sigma_m", prior.length_sigma_m, 1e-3, 50,
               "standard deviation of the length");
  visitor.Real("width_sigma_m", prior.width_sigma_m, 1e-3, 50, "standard deviation of the width");
  visitor.Real("height_sigma_m", prior.height_sigma_m, 1e-3, 50,
               "standard deviation of the height");
  visitor.Real("overhang", prior.overhang, 0, 0.5,
               "from either end to the axle; 0: no wheels [share of the length]");
  visitor.Real("roof", prior.roof, 0, 1,
               "the part that is as high as the object [share of the length]");
}

void DescribeFields(FieldVisitor& visitor, LiftOptions& options) {
  visitor.Nested("ground", options.ground, "the plane that objects stand on");
  visitor.Real("min_range_m", options.min_range_m, 0.1, 1000, "nearer objects are not lifted");
  visitor.Real("max_range_m", options.max_range_m, 0.1, 1000, "farther objects are not lifted");
  visitor.Real("min_height_px", options.min_height_px, 1, 10000,
               "boxes of a smaller height are not lifted");
  visitor.Real("max_yaw_sigma_rad", options.max_yaw_sigma_rad, 0.01, 10,
               "boxes whose yaw has a larger standard deviation are not lifted");
  visitor.Real("box_sigma_share", options.box_sigma_share, 0, 1,
               "standard deviation of a box's sides, share of its width or height, added to 2 px; "
               "the detector's description may raise it");
}

const char* ToString(LiftStatus status) {
  switch (status) {
    case LiftStatus::kLifted: return "lifted";
    case LiftStatus::kUnknownLabel: return "unknown label";
    case LiftStatus::kBadBox: return "bad box";
    case LiftStatus::kTooSmall: return "too small";
    case LiftStatus::kNoDepth: return "no depth";
    case LiftStatus::kOutOfRange: return "out of range";
    case LiftStatus::kPoorFit: return "poor fit";
    case LiftStatus::kAmbiguous: return "ambiguous heading";
  }
  return "";
}

}  // namespace sslcd
