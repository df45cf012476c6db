// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sslcd/core/error.h"
#include "sslcd/core/export.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/frontend/adapt.h"
#include "sslcd/frontend/image_frontend.h"
#include "sslcd/frontend/stereo_files.h"

namespace SSLCD_EXPORT sslcd {

/// The parts to make from the images of a recorded sequence.
struct ImageRequest {
  bool odometry = false;    ///< make poses by StereoOdometry
  bool detections = false;  ///< make detections by VisionOptions::detector or from `boxes`
  std::string boxes;        ///< file of 2D boxes (ReadBoxes) instead of a detector
  bool alignment = false;   ///< align images of different passes (LoopViewOptions::enabled)
};

/// Whether 2D boxes are lifted by stereo; 3D detectors measure the depth themselves. Throws Error
/// if the detector's description cannot be read.
bool LiftsBoxes(const ImageRequest& request, const VisionOptions& vision);

/// Whether odometry or cuboids come from disparities.
bool MeasuresByStereo(const ImageRequest& request, const VisionOptions& vision);

/// MakeStereoCamera for a dataset with both cameras. Errors contain the name of the dataset.
StereoCamera StereoCameraOf(const Dataset& dataset);

/// Examines the images before the run, for AdaptTo: the quality of their rectification and the
/// range at which to align their ground. If odometry or cuboids come from disparities, it also sets
/// the principal point of the right camera of `dataset` to the result of CheckRig.
ImageSource InspectImages(const ImageRequest& request, const VisionOptions& vision,
                          const StereoFiles& files, Dataset& dataset);

/// Makes the input of ImageFrontend for a request. Takes the frames out of `dataset`. Throws
/// Error(kBadInput) if the dataset lacks a camera or the file of boxes is malformed. Warns about
/// boxes of frames that do not exist.
ImageSequence MakeImageSequence(const ImageRequest& request, Dataset& dataset);

/// MakeGroundAligner for a dataset with its current cameras. The aligner checks the rig itself if
/// nothing else comes from disparities. Returns none if the request has no alignment or the dataset
/// lacks a second camera or stereo images. Warns if the cameras are not a rectified pair.
ViewAligner MakeGroundAligner(const ImageRequest& request, const Dataset& dataset,
                              const VisionOptions& vision, const StereoFiles& files,
                              GroundAlignerOptions options);

/// Returns the next frame; none at the end. Throws the errors of the first frame (`done` is 0) and
/// errors that concern all frames (kNoSolution). Stores any other error in `failure` and returns
/// none, so that the results of the earlier frames are kept.
std::optional<Frame> NextFrame(ImageFrontend& frontend, std::size_t done,
                               std::optional<Error>& failure);

}  // namespace sslcd
