// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "sslcd/core/camera.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"
#include "sslcd/odometry/options.h"

namespace SSLCD_EXPORT sslcd {

struct StereoOdometryOptions {
  /// number of tracked points, spread over the image; the time grows with it
  int points = 400;
  int window = 8;  ///< keyframes of the bundle adjustment; the oldest two are fixed
  /// CheckRig estimates the disparity at infinity; StereoOdometry never does
  bool calibrate = true;
};
void DescribeFields(FieldVisitor& visitor, StereoOdometryOptions& options);

/// The noise of stereo odometry for a mapper: the noise of real images, or less for a better
/// calibration, in headings down to a fifth. `row_error_rad` is RowError divided by the focal
/// length in px; none: real images. Figures: docs/notes, "Which noise?".
OdometryNoise StereoOdometryNoise(std::optional<double> row_error_rad = std::nullopt);

/// The source of a frame's pose.
enum class OdometryStatus {
  kFirst,    ///< the first frame, at the origin
  kTracked,  ///< measured
  kLost,     ///< guessed by repeating the last step
};
const char* ToString(OdometryStatus status);

/// One frame of the odometry.
struct OdometryStep {
  /// pose of the reference camera (see Camera::offset) in its frame at the first image
  Pose T_odom_cam;
  OdometryStatus status = OdometryStatus::kFirst;
  const char* reason = "";  ///< why the frame is lost; empty: it is not
  bool keyframe = false;    ///< the frame has added new points
  /// points that fit the pose; points found in the first frame and after a restart
  int points = 0;
  /// Covariance of the step from the previous frame, of the right perturbation of
  /// T_previous_current, [translation, rotation], in the current reference camera's axes; The
  /// variances are twice too large with exact calibration, and too small otherwise. For a guessed
  /// step, and for the step after it, which corrects the guess, it is the uncertainty of the
  /// constant velocity. Zero for the first frame.
  Pose::Matrix6 covariance = Pose::Matrix6::Zero();
};

/// Stereo visual odometry from rectified image pairs. Tracks corners of the last keyframe into each
/// new left image (Lucas-Kanade) and from there into the right one. Estimates the pose by P3P in
/// RANSAC and refines it over the inliers, whose patches are aligned to a fraction of a pixel with
/// the shape predicted from that pose. At keyframes it runs bundle adjustment of points and poses
/// over a window. After Scaramuzza and Fraundorfer, Visual odometry: part I, RAM 2011, and
/// Leutenegger et al., Keyframe-based visual-inertial odometry using nonlinear optimization, IJRR
/// 2015 (without its inertial part).
/// Frames must have equal time steps, since predictions assume a constant velocity. Use one object
/// per sequence; it is not thread-safe. The same images give the same bytes for any number of
/// OpenCV threads. It never revises a returned pose.
class StereoOdometry {
 public:
  /// Throws Error(kBadInput) if the camera has no focal length or baseline.
  StereoOdometry(const StereoCamera& camera, const StereoOdometryOptions& options);
  ~StereoOdometry();

  /// Throws Error(kBadInput) and changes nothing if the images are not a pair or differ in size
  /// from the first pair. A frame without texture (e.g. black) is not an error, but lost.
  OdometryStep AddFrame(const StereoView& images);

  /// Adds a frame whose images are missing. It is lost and gets a guessed pose.
  OdometryStep AddMissingFrame();

  /// The StereoCamera::disparity_at_infinity [px] that best fits the window of keyframes. None: the
  /// window is not full. CheckRig estimates its uncertainty.
  std::optional<double> DisparityAtInfinity() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Loads the left and right image of a frame. None: one is missing, or they are not a pair.
using PairLoader = std::function<std::optional<std::pair<Image, Image>>(std::size_t frame)>;

/// The calibration error of a rectified pair, estimated from its images.
struct RigCheck {
  std::optional<double> row_error;  ///< RowError [px]
  /// the StereoCamera::disparity_at_infinity to use [px]
  double disparity_at_infinity = 0;
  /// rows show a calibration error, but no frames allow to estimate the error of the columns
  bool unsure = false;
};

/// Measures the row error of pairs all over the sequence, and runs StereoOdometry on about eight
/// bursts of frames, each until its window is full. Each burst estimates the disparity at infinity
/// together with points and poses. A rotation of 0.01 degrees between the cameras shifts it by
/// about 0.1 px, which changes the distance of a point with a disparity of 20 px by 0.5 %, and the
/// scale of an odometry from such points by the same. It is -0.2 and -0.4 px on KITTI's drives
/// 09_30 and 10_03.
/// The result is a weighted mean of the calibrated value and the median of the bursts. The weights
/// come from the scatter of the bursts and from RowError, since columns are assumed to have the
/// same error as rows. The calibrated value stays if the row error is below 0.03 px or unknown, if
/// the estimated change is less than a quarter of the row error (a rolled right camera causes such
/// changes), or if options.calibrate is false.
/// Throws the errors of StereoOdometry.
RigCheck CheckRig(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                  const StereoOdometryOptions& options);

}  // namespace sslcd
