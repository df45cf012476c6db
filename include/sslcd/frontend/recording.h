// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/frontend/adapt.h"
#include "sslcd/frontend/image_frontend.h"
#include "sslcd/frontend/stereo_files.h"

namespace sslcd {

/// What is to be made from the images of a recorded sequence.
struct ImageRequest {
  bool odometry = false;    ///< poses, by StereoOdometry
  bool detections = false;  ///< by VisionOptions::detector, or from `boxes`
  std::string boxes;        ///< file of 2D boxes (ReadBoxes) instead of a detector
  bool alignment = false;   ///< images of different passes are aligned (LoopViewOptions::enabled)
};

/// Whether 2D boxes are lifted by stereo; 3D detectors bring the depth themselves. Throws Error
/// where the detector's description cannot be read.
bool LiftsBoxes(const ImageRequest& request, const VisionOptions& vision);

/// Whether odometry or cuboids are measured by disparities.
bool MeasuresByStereo(const ImageRequest& request, const VisionOptions& vision);

/// MakeStereoCamera of a dataset that has both cameras; errors name it.
StereoCamera StereoCameraOf(const Dataset& dataset);

/// Looks at the images before the run, for AdaptTo: how well they are rectified, and where their
/// ground should be aligned. Where something is measured by stereo, the right camera of `dataset`
/// gets the principal point that CheckRig finds.
ImageSource InspectImages(const ImageRequest& request, const VisionOptions& vision,
                          const StereoFiles& files, Dataset& dataset);

/// What ImageFrontend needs to make what is asked for. Takes the frames out of `dataset`. Throws
/// Error(kBadInput) where that lacks a camera, or the file of boxes is bad; a warning counts boxes
/// of frames that are not there.
ImageSequence MakeImageSequence(const ImageRequest& request, Dataset& dataset);

/// MakeGroundAligner for a dataset, with its cameras as they are now. Where nothing else is
/// measured by stereo, it checks the rig itself. None where nothing can be aligned: no second
/// camera, no pair of images, or not asked for; a warning says so where the cameras are no pair.
ViewAligner MakeGroundAligner(const ImageRequest& request, const Dataset& dataset,
                              const VisionOptions& vision, const StereoFiles& files,
                              GroundAlignerOptions options);

/// The next frame. An error is thrown where it is the first frame's (`done` is 0) or spoils all of
/// them (kNoSolution); else it is kept in `failure`, so that the results of the frames before are
/// not lost: then, as at the end, there is none.
std::optional<Frame> NextFrame(ImageFrontend& frontend, std::size_t done,
                               std::optional<Error>& failure);

}  // namespace sslcd
