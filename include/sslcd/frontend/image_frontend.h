// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/image.h"
#include "sslcd/core/label.h"
#include "sslcd/core/timing.h"
#include "sslcd/frontend/options.h"
#include "sslcd/perception/colour.h"

namespace sslcd {

/// 2D boxes of a sequence: frame number -> boxes.
using BoxesByFrame = std::map<int, std::vector<ImageDetection>>;

/// What the host does. Called from other threads where there is more than one, but never two calls
/// of one at a time.
struct FrontendHooks {
  /// reads an image file; an empty image where that fails
  std::function<Image(const std::string& path)> load;
  /// each complete frame with its left image, in order
  std::function<void(const Frame&, const ImageView&)> watch{};
};

/// What is to be made from images.
struct ImageSequence {
  std::vector<Frame> frames;  ///< with paths of both images, and whatever is known already
  StereoCamera camera;
  bool odometry = false;  ///< make T_odom_cam, by stereo odometry
  /// make detections, by VisionOptions::detector, or from these:
  bool detections = true;
  std::optional<BoxesByFrame> boxes;  ///< instead of a detector
};

/// Whether the ground is where VisionOptions::lift has it, which cuboids lifted from boxes stand
/// on: looked at in every tenth frame.
struct GroundReport {
  int frames = 0, elsewhere = 0;  ///< that were looked at; those among them where it is not
  /// of the camera over the ground, in the first of those where that can be told
  std::vector<double> heights_m;
};

/// What became of a sequence.
struct FrontendReport {
  int frames = 0;
  int images_failed = 0;           ///< frames that lack an image, or have one that cannot be read
  int lost = 0;                    ///< frames whose odometry had to be guessed, those among them
  std::map<LiftStatus, int> lift;  ///< boxes, by what became of them
  std::set<std::string> unknown;   ///< labels of boxes that lifting knows no sizes of
  GroundReport ground;
  int detections = 0;
  TimingTable timing;
};

/// Complete frames from stereo images: odometry, detections with boxes, colours and embeddings.
/// With more than one thread images are read, odometry, detections and whatever the caller does
/// with the frames are made at the same time, each on a thread of its own, and a sequence takes as
/// long as the slowest of them. The frames are the same.
///
/// A frame one of whose images is missing or cannot be read is kept: its odometry is guessed
/// (StereoOdometry) and it has no detections. A warning names it.
class ImageFrontend {
 public:
  /// Throws Error where a model cannot be loaded, there is nothing to make detections from, or no
  /// frame has images.
  ImageFrontend(ImageSequence sequence, const VisionOptions& options, const ColourOptions& colour,
                FrontendHooks hooks, int threads);
  ImageFrontend(ImageFrontend&&) noexcept;
  ~ImageFrontend();

  /// The next complete frame; none: that was the last one. Throws Error, with the frame's image,
  /// where both images are there but are no pair, or have the wrong number of channels, and where a
  /// model fails; after the last frame Error(kNoSolution) if odometry was asked for and not one of
  /// several frames could be followed.
  std::optional<Frame> Next();

  /// Labels of lifted cuboids, whose front and back are not told apart: Symmetry::kNone, of the
  /// table or by default, becomes kPi.
  void AddLabels(LabelTable& labels) const;

  /// Of the frames begun: more than were handed out where there is more than one thread and it ends
  /// early. Ends the sequence.
  FrontendReport Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
