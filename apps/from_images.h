// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "commands.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/frontend/recording.h"

namespace sslcd::apps {

/// The command-line options of `run` and `detect` for making frames from images.
struct ImageArguments {
  std::string detector, embedder, boxes;

  void AddTo(CLI::App& command);
  bool detects() const { return !detector.empty() || !boxes.empty(); }

  /// Adds the models named on the command line to the settings of the configuration.
  void AddTo(ConfigArguments& config) const;

  /// Requests odometry if `dataset` has none, and detections if `detections` is set.
  ImageRequest RequestFor(const Dataset& dataset, bool detections,
                          const Configuration& given) const;
};

/// The dataset's images, read by the tools. The sequence ends at an interrupt.
StereoFiles FilesOf(const Dataset& dataset);

/// Adapts the defaults to the images of `dataset` (InspectImages, AdaptTo) and keeps the keys that
/// the user has set. Prints the adapted keys. Throws Error if a required model file is missing.
Configuration AdaptToImages(const ConfigArguments& config, const Configuration& given,
                            const ImageRequest& request, Dataset& dataset, const Console& console);

/// "--odometry stereo" requests odometry from the images. Without --odometry the dataset's file is
/// used if there is one.
void ChooseOdometry(DatasetRequest& request);

void WarnOfFrontend(const FrontendReport& report);

/// Counts of images, boxes and detections as a table for people, and as JSON.
std::string FrontendTable(const FrontendReport& report);
std::string FrontendJson(const FrontendReport& report);

}  // namespace sslcd::apps
