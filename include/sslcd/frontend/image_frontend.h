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
#include "sslcd/core/export.h"
#include "sslcd/core/image.h"
#include "sslcd/core/label.h"
#include "sslcd/core/timing.h"
#include "sslcd/frontend/options.h"
#include "sslcd/perception/colour.h"

namespace SSLCD_EXPORT sslcd {

/// The 2D boxes of a sequence by frame number.
using BoxesByFrame = std::map<int, std::vector<ImageDetection>>;

/// Functions of the host. With several threads they run on other threads, but one function never
/// runs twice at the same time.
struct FrontendHooks {
  /// reads an image file; returns an empty image on failure
  std::function<Image(const std::string& path)> load;
  /// receives each complete frame with its left image, in order
  std::function<void(const Frame&, const ImageView&)> watch{};
};

/// A sequence of frames and the parts to make from its images.
struct ImageSequence {
  std::vector<Frame> frames;  ///< with the paths of both images and all known parts
  StereoCamera camera;
  bool odometry = false;  ///< compute T_odom_cam by stereo odometry
  /// make detections, by VisionOptions::detector or from `boxes`
  bool detections = true;
  std::optional<BoxesByFrame> boxes;  ///< instead of a detector
};

/// Checks of the ground plane of VisionOptions::lift, on which lifted cuboids stand, in every tenth
/// frame.
struct GroundReport {
  int frames = 0, elsewhere = 0;  ///< checked frames; those whose ground lies elsewhere
  /// estimated heights of the camera over the ground in the first frames counted by `elsewhere`
  std::vector<double> heights_m;
};

/// Statistics of a processed sequence.
struct FrontendReport {
  int frames = 0;                  ///< frames read
  int images_failed = 0;           ///< frames with a missing or unreadable image
  int lost = 0;                    ///< frames with a guessed pose, including those without images
  std::map<LiftStatus, int> lift;  ///< number of boxes by result
  std::set<std::string> unknown;   ///< labels of boxes without known sizes
  GroundReport ground;
  int detections = 0;  ///< detections of all frames
  TimingTable timing;
};

/// Makes complete frames from stereo images: odometry, and detections with boxes, colours and
/// embeddings. With several threads, reading images, odometry, detections and the caller's work run
/// in parallel, each on its own thread; the slowest of them determines the time. The frames do not
/// depend on the number of threads.
/// A frame with a missing or unreadable image stays in the sequence: its pose is guessed
/// (StereoOdometry), it has no detections, and a warning names it.
class ImageFrontend {
 public:
  /// Throws Error if a model cannot be loaded, if detections are requested without a detector or
  /// boxes, or if no frame has images.
  ImageFrontend(ImageSequence sequence, const VisionOptions& options, const ColourOptions& colour,
                FrontendHooks hooks, int threads);
  ImageFrontend(ImageFrontend&&) noexcept;
  ~ImageFrontend();

  /// Returns the next complete frame; none at the end. Throws Error with the name of the image if
  /// the two images are not a stereo pair or have a wrong number of channels, or if a model fails.
  /// At the end it throws Error(kNoSolution) if odometry was requested and every frame was lost.
  std::optional<Frame> Next();

  /// Sets the symmetry of the labels of lifted cuboids: Symmetry::kNone, in the table or by
  /// default, becomes kPi, because lifting does not distinguish front and back.
  void AddLabels(LabelTable& labels) const;

  /// Ends the sequence and returns the statistics of all started frames. With several threads and
  /// an early end these are more frames than Next() has returned.
  FrontendReport Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
