// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "commands.h"
#include "sslcd/core/error.h"
#include "sslcd/frontend/image_frontend.h"
#include "sslcd/io/dataset.h"
#include "sslcd/pipeline/view_aligner.h"

namespace sslcd::apps {

/// What `run` and `detect` are told about making frames from images.
struct ImageArguments {
  std::string detector, embedder, boxes;

  void AddTo(CLI::App& command);
  bool detects() const { return !detector.empty() || !boxes.empty(); }

  /// The configuration with these in it, from other defaults: cuboids lifted from 2D boxes bring
  /// their own noise, and a loss that suits the headings which are a quarter turn off; so does
  /// odometry from images, by how well these are rectified, and it is good enough for
  /// `loop.odometry` to be `ba.odometry`; and where both come from the same images there is no
  /// scale to estimate, since a wrong baseline stretches both alike, and aligned images.
  /// `detections`: they are made, too. Where frames are made from stereo, the right camera of
  /// `dataset` gets the principal point that CheckRig finds.
  Configuration Load(ConfigArguments config, Dataset& dataset, bool detections) const;

  /// Whether odometry or cuboids are measured by disparities, rather than given or found by a 3D
  /// detector.
  bool MeasuresByStereo(const VisionOptions& vision, const Dataset& dataset, bool detections) const;

  /// The frontend that makes what `dataset` lacks: odometry where no path was found, detections if
  /// `detections`. Takes the frames out of `dataset`, and adds labels to it. None: nothing is
  /// lacking.
  std::optional<ImageFrontend> Make(
      Dataset& dataset, const Configuration& configuration, bool detections, int threads,
      std::function<void(const Frame&, const ImageView&)> watch = {}) const;

  /// Aligns frames by the ground in their stereo images (AlignGround), which are read again. None:
  /// `dataset` lacks a second camera or the images, or `loop.views` is off. Where nothing else is
  /// measured by stereo, CheckRig finds the right camera's principal point when the first frames
  /// are to be aligned. To be called before Make(). Answers nothing more after an interrupt.
  ViewAligner MakeAligner(const Dataset& dataset, const Configuration& configuration, int threads,
                          std::function<void(int done, int total)> progress) const;
};

/// The next frame. Its error is thrown where it is the first one (`done` is 0) or spoils all of
/// them (kNoSolution), else kept in `failure`, so that the results of the frames before are not
/// lost: then, as at the end, there is none.
std::optional<Frame> NextFrame(ImageFrontend& frontend, std::size_t done,
                               std::optional<Error>& failure);

/// "--odometry stereo" asks for odometry from the images; no --odometry takes a file where there is
/// one.
void ChooseOdometry(DatasetRequest& request);

/// What became of images and boxes: for people.
std::string FrontendTable(const FrontendReport& report);

}  // namespace sslcd::apps
