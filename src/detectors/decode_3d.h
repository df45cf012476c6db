// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include "detectors/decode_2d.h"
#include "inference/tensor.h"
#include "sslcd/core/detection.h"

namespace sslcd {

/// A cuboid of a model's output: image of its centre in the input, depth and observation angle.
struct ClassCuboid {
  ClassBox found;                     ///< box in the input; without area if the model has no boxes
  double centre_x = 0, centre_y = 0;  ///< image of the cuboid's centre in the input [px]
  double depth_m = 0;
  double alpha_rad = 0;  ///< KITTI's observation angle: rotation_y minus the bearing of the centre
  Vec3 dims{0, 0, 0};    ///< length, width, height [m]
};

/// Mean and standard deviation of z, sin 2a, cos 2a, w, h, l for each anchor of a cell, [scale *
/// ratios + ratio].
struct AnchorPriors {
  std::vector<std::array<double, 6>> mean, std;
};

/// Reads the files of ModelAnchors by class number. Throws Error(kBadInput) if a file does not have
/// 6 columns and one row per anchor of a cell.
std::map<int, AnchorPriors> LoadAnchorPriors(const ModelOutput& output);

/// The camera whose image is the input. It keeps the offset of the left camera.
Camera CameraOfInput(const Camera& left, const InputMap& map);

/// VisualDet3D's Stereo3D (Liu et al., YOLOStereo3D, ICRA 2021) and Yolo3D (Ground-aware monocular
/// 3D detection, RA-L 2021): for each anchor logits of each class and of "alpha, not alpha + pi",
/// and 12 regression values. `camera` is the camera of the input.
std::vector<ClassCuboid> DecodeAnchors(const std::vector<Tensor>& outputs,
                                       const ModelOutput& output,
                                       const std::map<int, AnchorPriors>& priors,
                                       const Camera& camera, int width, int height);

/// Decodes heads like those of MonoFlex (Zhang et al., CVPR 2021) and SMOKE: peaks of the heat map
/// with offset, depth, size and rotation, as an angle or in 2 or 4 bins. Boxes have no area.
std::vector<ClassCuboid> DecodeMonoFlex(const std::vector<Tensor>& outputs,
                                        const ModelOutput& output, int width);

/// The cuboid in the reference camera's frame, without label, score and box.
Detection CuboidInCamera(const ClassCuboid& cuboid, const Camera& camera);

}  // namespace sslcd
