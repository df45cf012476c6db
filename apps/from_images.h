// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "commands.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/frontend/recording.h"

namespace sslcd::apps {

/// What `run` and `detect` are told about making frames from images.
struct ImageArguments {
  std::string detector, embedder, boxes;

  void AddTo(CLI::App& command);
  bool detects() const { return !detector.empty() || !boxes.empty(); }

  /// The models named on the command line, as settings of the configuration.
  void AddTo(ConfigArguments& config) const;

  /// Odometry where `dataset` has none; detections if asked for.
  ImageRequest RequestFor(const Dataset& dataset, bool detections,
                          const Configuration& given) const;
};

/// The dataset's images, read by the tools; nothing more after an interrupt.
StereoFiles FilesOf(const Dataset& dataset);

/// The configuration with what the images of `dataset` bring under what the user has set
/// (InspectImages, AdaptTo), and a line that says which keys that are. Throws Error where models
/// that are needed are not there.
Configuration AdaptToImages(const ConfigArguments& config, const Configuration& given,
                            const ImageRequest& request, Dataset& dataset, const Console& console);

/// "--odometry stereo" asks for odometry from the images; no --odometry takes a file where there is
/// one.
void ChooseOdometry(DatasetRequest& request);

/// What became of images and boxes: for people.
std::string FrontendTable(const FrontendReport& report);

}  // namespace sslcd::apps
