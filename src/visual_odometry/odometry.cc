// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/visual_odometry/odometry.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <set>
#include <string>

#include "core/median.h"
#include "sslcd/core/error.h"
#include "stereo/bundle.h"
#include "stereo/image_pyramids.h"
#include "visual_odometry/corners.h"
#include "visual_odometry/odometry_follow.h"

namespace sslcd {
namespace {

// Rotations to try if the prediction fails: up to 15 degrees, in steps within the range of the
// coarsest patches. Set by hand.
constexpr int kTurns = 3;
constexpr double kTurnRad = 0.09;
constexpr int kFixedKeyframes = 2;  // oldest ones of the window; set by hand
// A new keyframe is due if its points have moved by this distance (median, [px]), or if fewer than
// this share of them is still tracked. Not tuned.
constexpr double kKeyframePx = 8, kKeyframeShare = 0.8;
// Most consecutive lost frames (black images, a wiper) before the odometry restarts at its last
// guess. Not tuned.
constexpr int kPatience = 2;
constexpr double kLossPx = 0.15;  // best of .08 to 1, on rendered and on real images

const char* const kNoCorners = "nothing to follow: too few corners in the images";
const char* const kNoPairs =
    "nothing to follow: too few corners of the left image have a disparity (are left and right "
    "swapped, or not "
    "rectified, or is all far away?)";
const char* const kNoneBefore = "no frame before could be followed";
const char* const kMissing = "its images are missing";

/// Covariance of repeating a step `steps` times at constant velocity: half of the step plus a
/// constant, for each.
Pose::Matrix6 GuessCovariance(const Pose& step, int steps) {
  constexpr double kShare = 0.5, kLeastM = 0.1, kLeastRad = 0.02;  // set by hand
  const double translation = steps * (kLeastM + kShare * step.translation().norm());
  const double rotation = steps * (kLeastRad + kShare * step.so3().Log().norm());
  Vec6 variances;
  variances << Vec3::Constant(translation * translation), Vec3::Constant(rotation * rotation);
  return variances.asDiagonal();
}

std::vector<StereoFrame*> Pointers(std::deque<StereoFrame>& frames) {
  std::vector<StereoFrame*> pointers;
  for (StereoFrame& frame : frames) pointers.push_back(&frame);
  return pointers;
}

}  // namespace

class SSLCD_HIDDEN StereoOdometry::Impl {
 public:
  Impl(const StereoCamera& camera, const StereoOdometryOptions& options)
      : camera_(camera), options_(options), T_left_ref_(Pose::Trans(camera.left.offset)) {
    if (camera.left.fx > 0 && camera.left.fy > 0 && camera.baseline_m > 0) return;
    throw Error(ErrorKind::kBadInput,
                "stereo odometry needs focal lengths and a baseline that are not zero: "
                "make the camera from P2 and P3 of calib.txt with MakeStereoCamera()");
  }

  OdometryStep AddFrame(const StereoView& images) {
    CheckImages(images);
    const cv::Size size(images.left.width, images.left.height);
    if (size_.area() > 0 && size != size_)
      throw Error(ErrorKind::kBadInput,
                  "the images are " + std::to_string(size.width) + "x" +
                      std::to_string(size.height) + ", those of the first frame were " +
                      std::to_string(size_.width) + "x" + std::to_string(size_.height));
    size_ = size;
    const StereoPyramids current = BuildPyramids(images, kPatchPx);
    if (keyframes_.empty()) return Start(current);
    reason_ = "";
    if (std::optional<StereoFrame> frame = Track(current)) return Accept(*frame, current);
    OdometryStep step = Bridge(reason_);
    if (lost_ > kPatience) StartAnew(current);
    return step;
  }

  OdometryStep AddMissingFrame() { return Bridge(kMissing); }

  std::optional<double> DisparityAtInfinity() const {
    if (static_cast<int>(keyframes_.size()) < options_.window) return std::nullopt;
    std::deque<StereoFrame> keyframes = keyframes_;
    OdometryPoints points = points_;
    return RefineWindow(camera_, 1, Pointers(keyframes), kLossPx, points, true);
  }

 private:
  OdometryStep Start(const StereoPyramids& current) {
    if (!any_frame_) {
      any_frame_ = true;
      StartAnew(current);
      OdometryStep step;
      step.points = static_cast<int>(last_.sightings.size());
      step.keyframe = !keyframes_.empty();
      return step;
    }
    OdometryStep step = Bridge("");
    StartAnew(current);
    step.reason = keyframes_.empty() ? reason_ : kNoneBefore;
    return step;
  }

  /// Starts a window of one keyframe at the pose of the last frame, if it has enough points.
  void StartAnew(const StereoPyramids& current) {
    keyframes_.clear();
    points_.clear();
    StereoFrame frame{last_.T_odom_left, {}};
    const int corners = TakeUpPoints(current, frame);
    if (static_cast<int>(frame.sightings.size()) < kMinTracked) {
      reason_ = corners < kMinTracked ? kNoCorners : kNoPairs;
      return;
    }
    keyframes_.push_back(frame);
    reference_images_ = current;
    last_ = frame;
    T_last_tracked_ = frame.T_odom_left;
    lost_ = 0;
  }

  /// Predicts with the velocity of the last frame.
  OdometryStep Bridge(const char* reason) {
    any_frame_ = true;
    ++lost_;
    last_ = {last_.T_odom_left * velocity_, {}};
    OdometryStep step = Report(OdometryStatus::kLost, GuessCovariance(velocity_, lost_));
    step.reason = reason;
    return step;
  }

  OdometryStep Accept(StereoFrame& frame, const StereoPyramids& current) {
    const StereoFrame& before = last_.sightings.empty() ? keyframes_.back() : last_;
    constexpr double kLeastNoise = 0.1;  // [px] lower bound of the noise; set by hand
    const double noise =
        std::max(kLeastNoise, ResidualScale(camera_, frame, points_).norm() / std::sqrt(3.));
    Pose::Matrix6 covariance = StepCovariance(camera_, before, frame, points_, noise);
    if (lost_ > 0) covariance += GuessCovariance(velocity_, lost_);

    const bool keyframe = KeyframeIsDue(frame);
    const int points = static_cast<int>(frame.sightings.size());
    if (keyframe) AddKeyframe(frame, current);
    // The step spans lost frames, since their poses were guesses.
    const Vec6 moved = (T_last_tracked_.inverse() * frame.T_odom_left).Log() / (lost_ + 1);
    velocity_ = Pose::Exp(moved);
    T_last_tracked_ = frame.T_odom_left;
    lost_ = 0;
    last_ = frame;
    OdometryStep step = Report(OdometryStatus::kTracked, covariance);
    step.keyframe = keyframe;
    step.points = points;
    return step;
  }

  /// Transforms a pose from the left camera to the reference camera.
  OdometryStep Report(OdometryStatus status, const Pose::Matrix6& covariance) const {
    OdometryStep step;
    step.status = status;
    const Pose T_ref_left = T_left_ref_.inverse();
    step.T_odom_cam = T_ref_left * last_.T_odom_left * T_left_ref_;
    // T_left Exp(d) = T_left_ref T_ref Exp(Adj(T_ref_left) d) T_ref_left
    const Pose::Matrix6 adjoint = T_ref_left.Adj();
    step.covariance = adjoint * covariance * adjoint.transpose();
    return step;
  }

  std::optional<StereoFrame> Track(const StereoPyramids& current) {
    std::optional<StereoFrame> frame = Track(reference_images_.left, current.left, current);
    if (frame) return frame;
    // The brightness may have changed.
    return Track(NormaliseContrast(reference_images_.left, kPatchPx),
                 NormaliseContrast(current.left, kPatchPx), current);
  }

  std::optional<StereoFrame> Track(const ImagePyramid& reference, const ImagePyramid& left,
                                   const StereoPyramids& current) {
    const TrackedKeyframe tracked{camera_, keyframes_.back(), points_};
    const Pose T_expected = last_.T_odom_left * velocity_;
    const auto find = [&](const Pose& T_guess) {
      return FindPose(tracked, reference, left, T_guess, reason_);
    };
    std::optional<Pose> pose = find(T_expected);
    if (!pose) pose = find(last_.T_odom_left);
    // The camera may have started or stopped turning.
    for (int k = 1; k <= kTurns && !pose; ++k) {
      pose = find(T_expected * Pose::RotY(k * kTurnRad));
      if (!pose) pose = find(T_expected * Pose::RotY(-k * kTurnRad));
    }
    if (!pose) return std::nullopt;
    StereoFrame frame = FindAll(tracked, reference, left, current, *pose);
    RefinePose(camera_, points_, kLossPx, frame);
    DropMisfits(frame);
    if (static_cast<int>(frame.sightings.size()) >= kMinTracked) return frame;
    reason_ = kTooFewFound;
    return std::nullopt;
  }

  void DropMisfits(StereoFrame& frame) const {
    const auto misfit = [&](const StereoSighting& sighting) {
      return !(StereoError(camera_, frame, sighting, points_.at(sighting.point)) <= kFitsWithinPx);
    };
    auto& sightings = frame.sightings;
    sightings.erase(std::remove_if(sightings.begin(), sightings.end(), misfit), sightings.end());
  }

  bool KeyframeIsDue(const StereoFrame& frame) const {
    const StereoFrame& reference = keyframes_.back();
    if (frame.sightings.size() < kKeyframeShare * reference.sightings.size()) return true;
    std::map<int, StereoPixel> then;
    for (const StereoSighting& sighting : reference.sightings)
      then[sighting.point] = sighting.pixel;
    std::vector<double> ways;
    for (const StereoSighting& sighting : frame.sightings) {
      const StereoPixel& was = then.at(sighting.point);
      ways.push_back(std::hypot(sighting.pixel.left - was.left, sighting.pixel.row - was.row));
    }
    return !ways.empty() && Median(ways) > kKeyframePx;
  }

  void AddKeyframe(StereoFrame& frame, const StereoPyramids& current) {
    TakeUpPoints(current, frame);
    keyframes_.push_back(frame);
    if (static_cast<int>(keyframes_.size()) > options_.window) keyframes_.pop_front();
    const int fixed = std::min<int>(kFixedKeyframes, static_cast<int>(keyframes_.size()) - 1);
    RefineWindow(camera_, fixed, Pointers(keyframes_), kLossPx, points_);
    DropMisfits(keyframes_.back());
    ForgetPoints();
    reference_images_ = current;
    frame = keyframes_.back();
  }

  /// Adds points in areas without points, with depths from their disparity. Returns the number of
  /// corners.
  int TakeUpPoints(const StereoPyramids& current, StereoFrame& frame) {
    std::vector<cv::Point2f> taken;
    for (const StereoSighting& sighting : frame.sightings)
      taken.push_back(ToCv(sighting.pixel.left, sighting.pixel.row));
    const std::vector<cv::Point2f> corners =
        SpreadCorners(current, taken, options_.points, kPatchPx);
    const TrackedPoints right =
        TrackForthAndBack(current.left, current.right, corners, corners, kCoarse, kPatchPx);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!right.found[i]) continue;
      const std::optional<StereoPixel> pixel =
          MeasurePair(camera_, current, corners[i], right.at[i]);
      if (!pixel) continue;
      points_[next_point_] = frame.T_odom_left * Triangulate(camera_, *pixel);
      frame.sightings.push_back({next_point_++, *pixel});
    }
    return static_cast<int>(corners.size());
  }

  /// Removes points that no keyframe of the window sees.
  void ForgetPoints() {
    std::set<int> seen;
    for (const StereoFrame& keyframe : keyframes_)
      for (const StereoSighting& sighting : keyframe.sightings) seen.insert(sighting.point);
    for (auto it = points_.begin(); it != points_.end();)
      it = seen.count(it->first) ? std::next(it) : points_.erase(it);
  }

  const StereoCamera camera_;
  const StereoOdometryOptions options_;
  const Pose T_left_ref_;
  cv::Size size_;
  bool any_frame_ = false;
  std::deque<StereoFrame> keyframes_;  // the last one is the reference, whose points are tracked
  StereoPyramids reference_images_;
  OdometryPoints points_;
  int next_point_ = 0;
  StereoFrame last_;     // lost if it has no sightings
  Pose T_last_tracked_;  // of the left camera
  Pose velocity_;        // T_before_now per frame
  int lost_ = 0;         // consecutive lost frames
  const char* reason_ = "";
};

StereoOdometry::StereoOdometry(const StereoCamera& camera, const StereoOdometryOptions& options)
    : impl_(std::make_unique<Impl>(camera, options)) {}
StereoOdometry::~StereoOdometry() = default;
OdometryStep StereoOdometry::AddFrame(const StereoView& images) { return impl_->AddFrame(images); }
OdometryStep StereoOdometry::AddMissingFrame() { return impl_->AddMissingFrame(); }
std::optional<double> StereoOdometry::DisparityAtInfinity() const {
  return impl_->DisparityAtInfinity();
}

}  // namespace sslcd
