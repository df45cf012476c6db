// SPDX-License-Identifier: BSD-3-Clause
#include "check/boxes.h"
#include "check/checks.h"
#include "check/detection_units.h"
#include "check/embeddings.h"
#include "check/ground_truth.h"
#include "check/headings.h"
#include "check/labels_scores.h"
#include "check/pose_conventions.h"
#include "check/stamps.h"
#include "check/synchronisation.h"
#include "check/up_axis.h"

namespace sslcd::check {

namespace {

std::vector<Check> DetectionChecks() {
  return {{"frame numbers",
           "least, greatest and common divisor of the numbers",
           "10 detections, one of a frame without a pose",
           {{"frame_numbers", "frames counted from 1, in steps of 10, or otherwise than the poses",
             "detections: number frames from 0, as the rows of the odometry", true}},
           CheckFrameNumbers},
          {"cuboid units",
           "medians of the longest side and of the distance",
           "20 detections",
           {{"cuboid_units", "sizes or places in mm or cm", "detections: write metres", true}},
           CheckCuboidUnits},
          {"detection axes",
           "spread of x and of z, median of z",
           "50 detections",
           {{"velodyne_frame", "places in a laser's axes (x forward, z up)",
             "detections: multiply by T_cam_velo of the calibration, which --fix does not know",
             false}},
           CheckDetectionAxes},
          {"2D boxes",
           "median IoU of the 2D boxes with those of the projected cuboids",
           "30 boxes that the image does not cut, calibration",
           {{"size_order", "sizes in another order", "detections: write the sizes as h w l", true},
            {"box_centre", "places of the centre or the top",
             "detections: write the centre of the bottom face", true},
            {"box_format", "boxes as x y w h, as shares of the image, or y before x",
             "detections: write boxes as left top right bottom in px", true},
            {"focal_length", "another focal length, or images of another size",
             "calib.txt: the P2 of the images in which the boxes were found", true},
            {"wrong_camera", "the row of another camera as P2",
             "calib.txt: give the camera of the boxes as P2", true},
            {"no_calibration", "2D boxes, but no calibration",
             "add calib.txt with P2, or remove the boxes (-1 -1 -1 -1)", false}},
           CheckBoxes}};
}

std::vector<Check> MotionChecks() {
  return {
      {"stamps",
       "median step of the stamps, speed",
       "3 frames",
       {{"stamp_units", "stamps in ns, us or ms", "times.txt, odometry.txt: write seconds", true}},
       CheckStampUnits},
      {"odometry units",
       "scatter of static objects with positions in other units; speed",
       "15 steps",
       {{"odometry_units", "positions in mm, cm or km", "odometry: write metres", true}},
       CheckOdometryUnits},
      {"pose convention",
       "scatter of static objects from one frame to a later one, in 20 parts of the run",
       "60 objects that are seen again, 15 pairs of frames",
       {{"inverse_poses", "T_cam_world for T_world_cam", "odometry: invert the poses", true},
        {"quaternion_order", "quaternions as qw qx qy qz", "odometry: write qx qy qz qw", true},
        {"ros_axes", "poses of a body with x forward, y left, z up",
         "odometry: multiply by the camera's pose in the body on the right", true},
        {"opengl_axes", "poses with x right, y up, z backward",
         "odometry: turn to x right, y down, z forward", true},
        {"rotation_inverse", "rotations from world to camera, beside positions in the world",
         "odometry: transpose the rotations", true},
        {"mirrored_poses", "one axis mirrored, or a left-handed world",
         "odometry: change the sign of one axis, of rotations too", true},
        {"swapped_axes", "two axes swapped", "odometry: swap them back, in rotations too", true},
        {"other_axes", "other axes of the camera", "odometry: turn to x right, y down, z forward",
         true}},
       CheckPoseConvention},
      {"synchronisation",
       "turns of the camera as objects show them, and those of the odometry up to 10 frames off",
       "100 steps with two objects that are seen again, a camera that looks along its path",
       {{"shifted_stamps", "odometry some frames early or late",
         "times.txt or detections: correct the frames", true},
        {"other_odometry", "odometry of another drive", "name the right file (--odometry)", false}},
       CheckSynchronisation}};
}

std::vector<Check> HeadingChecks() {
  return {
      {"headings",
       "alpha against rotation_y, IoU of the 2D boxes, headings of static objects while the camera "
       "turns",
       "30 elongated objects of a label with a heading",
       {{"heading_degrees", "rotation_y in degrees", "detections: write radians", true},
        {"heading_sign", "rotation_y about the upward axis",
         "detections: change the sign of rotation_y", true},
        {"heading_quarter_turn", "rotation_y from the camera's z axis",
         "detections: add a quarter turn to rotation_y", true},
        {"heading_half_turn", "front and back swapped", "detections: add half a turn to rotation_y",
         true},
        {"heading_axes", "a yaw about z up, from x forward",
         "detections: rotation_y = -yaw - pi / 2", true},
        {"heading_is_alpha", "alpha in the column of rotation_y",
         "detections: rotation_y = alpha + atan2(x, z)", true},
        {"no_heading", "one rotation_y in all rows",
         "detections: write headings, or symmetry: full into sequence.yaml", false}},
       CheckHeadings},
      {"up axis",
       "normal of the ground on which objects are",
       "50 objects on one ground, seen two by two; an upright camera",
       {{"up_axis", "another up than the one declared", "sequence.yaml: up_axis", true}},
       CheckUpAxis}};
}

std::vector<Check> OtherChecks() {
  return {
      {"scores",
       "least and greatest score",
       "20 detections",
       {{"score_percent", "scores in per cent", "detections: divide the scores by 100", true}},
       CheckScores},
      {"labels",
       "spelling, without case, signs and plural",
       "10 detections of a label, labels in sequence.yaml",
       {{"unknown_labels", "labels that sequence.yaml spells otherwise",
         "sequence.yaml or detections: spell them alike", true}},
       CheckLabels},
      {"symmetry",
       "length against width, headings of static objects",
       "30 detections of a label",
       {{"no_symmetry", "objects without a front that are taken to have one",
         "sequence.yaml: labels: {LABEL: {symmetry: full}}", true}},
       CheckSymmetry},
      {"embeddings",
       "share of comparisons in which one object seen twice is more alike than two objects (AUC)",
       "100 detections, 60 objects that are seen again",
       {{"embeddings_shuffled", "rows that are not those of the detections",
         "embeddings.npy: make it in the order of the detections' rows", false},
        {"embeddings_constant", "one vector for all objects",
         "embeddings.npy: make it from crops of the images", false},
        {"embeddings_empty", "rows of zeros", "embeddings.npy: make it, or remove it", false}},
       CheckEmbeddings},
      {"ground truth",
       "distances between places and directions of motion, in ground truth and odometry",
       "8 distances",
       {{"groundtruth_inverse", "T_cam_world for T_world_cam", "ground truth: invert the poses",
         true},
        {"groundtruth_units", "positions in mm or cm", "ground truth: write metres", true},
        {"groundtruth_other", "ground truth of another drive",
         "name the right file (--groundtruth)", false},
        {"groundtruth_axes", "poses of a body with x forward or z backward, not of the camera",
         "ground truth: multiply by the camera's pose in the body on the right", true}},
       CheckGroundTruth}};
}

}  // namespace

// docs/check.md shows this table.
const std::vector<Check>& Checks() {
  static const std::vector<Check> all = [] {
    std::vector<Check> checks;
    for (const auto& part : {DetectionChecks(), MotionChecks(), HeadingChecks(), OtherChecks()})
      checks.insert(checks.end(), part.begin(), part.end());
    return checks;
  }();
  return all;
}

}  // namespace sslcd::check
