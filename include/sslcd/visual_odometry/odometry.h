// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "sslcd/core/camera.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"
#include "sslcd/odometry/options.h"

namespace sslcd {

struct StereoOdometryOptions {
  /// image points followed, spread over the image; time grows with them
  int points = 400;
  int window = 8;  ///< keyframes adjusted together, of which the oldest two are held fixed
  /// CheckRig estimates the disparity at infinity; StereoOdometry takes the camera as it is
  bool calibrate = true;
};
void DescribeFields(FieldVisitor& visitor, StereoOdometryOptions& options);

/// What a mapper should take such odometry's noise for: that of real images, or as much less, in
/// headings down to a fifth, as `row_error_rad` (RowError over the focal length in px) tells that
/// calibration is nearer to ideal. None: not known, taken for real ones. Figures: docs/notes,
/// "Which noise?".
OdometryNoise StereoOdometryNoise(std::optional<double> row_error_rad = std::nullopt);

/// How a frame got its pose.
enum class OdometryStatus {
  kFirst,    ///< it is the first one, the origin
  kTracked,  ///< measured
  kLost,     ///< guessed: the last step is taken once more
};
const char* ToString(OdometryStatus status);

/// One frame of the odometry.
struct OdometryStep {
  /// of the reference camera (see Camera::offset), in the axes that it had in the first frame
  Pose T_odom_cam;
  OdometryStatus status = OdometryStatus::kFirst;
  const char* reason = "";  ///< why it is lost; empty: it is not
  bool keyframe = false;    ///< new points were taken up here
  /// points that fit the pose; of the first frame, and of one started anew, points found
  int points = 0;
  /// Covariance of the step from the previous frame, of the right perturbation of
  /// T_previous_current, [translation, rotation], in the current reference camera's axes; its
  /// variances are twice too large where calibration is exact, and too small where it is not. Of a
  /// step that was guessed, and of the one after it, which takes the error of the guess back, what
  /// constant velocity may be off by. Zero for the first frame.
  Pose::Matrix6 covariance = Pose::Matrix6::Zero();
};

/// Stereo visual odometry: the path of the camera from rectified image pairs alone. Corners of the
/// last keyframe are found again in each new left image (Lucas-Kanade), and from there in the right
/// one; the pose that most of them agree on (P3P in RANSAC), refined over all that fit, whose
/// patches are found to a fraction of a pixel as they must look from there; at keyframes, points
/// and poses of a window adjusted together, each point by where it appears in all left and right
/// images (bundle adjustment). After Scaramuzza and Fraundorfer, Visual odometry: part I, RAM 2011,
/// and Leutenegger et al., Keyframe-based visual-inertial odometry using nonlinear optimization,
/// IJRR 2015 (without its inertial part).
///
/// Frames come at even intervals: what is guessed assumes that the camera moves on as it did. One
/// object per sequence, not thread-safe; the same images give the same bytes for any number of
/// OpenCV threads. A pose that has been returned is not revised.
class StereoOdometry {
 public:
  /// Throws Error(kBadInput) on a camera without focal length or baseline.
  StereoOdometry(const StereoCamera& camera, const StereoOdometryOptions& options);
  ~StereoOdometry();

  /// Throws Error(kBadInput), and leaves everything as it was, where the images are no pair or have
  /// not the size of the first one. Images in which there is nothing to see (black, no texture) are
  /// no error: such a frame is lost.
  OdometryStep AddFrame(const StereoView& images);

  /// A frame whose images are missing: it is lost, and has a pose nevertheless.
  OdometryStep AddMissingFrame();

  /// StereoCamera::disparity_at_infinity [px] that fits what the window of keyframes has seen best.
  /// None: it is not full. CheckRig says how far to believe it.
  std::optional<double> DisparityAtInfinity() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The left and right image of a frame. None: it has not both, or they are no pair.
using PairLoader = std::function<std::optional<std::pair<Image, Image>>(std::size_t frame)>;

/// How far off the calibration of a rectified pair is, as its images tell.
struct RigCheck {
  std::optional<double> row_error;  ///< RowError [px]
  /// of StereoCamera, what should be used instead of what it has [px]
  double disparity_at_infinity = 0;
  /// rows show that calibration is off, and no frames tell by how much columns are
  bool unsure = false;
};

/// Looks at pairs all over the sequence for their row error, and drives StereoOdometry through some
/// eight bursts of frames, each until its window is full. In each the disparity at infinity is
/// adjusted together with points and poses: a hundredth of a degree between the cameras, or 0.1 px,
/// is 0.5 % of the distance of a point with 20 px, and of the way that an odometry by such points
/// goes. Of KITTI's drives 09_30 and 10_03 it is -0.2 and -0.4 px.
///
/// The median of the bursts counts as much as it is surer, by their scatter, than calibration,
/// which is taken to be as far off in columns as it is in rows (RowError). Where rows fit to 0.03
/// px, or their error is not known, or what is found is less than a quarter of it, as a rolled
/// right camera has it, or options.calibrate is off, it stays.
///
/// Throws Error(kBadInput) as StereoOdometry does.
RigCheck CheckRig(const StereoCamera& camera, std::size_t frames, const PairLoader& load,
                  const StereoOdometryOptions& options);

}  // namespace sslcd
