// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::python {

/// A Mapper whose calls take turns, so that threads may share one. They run without the GIL.
class MapperInTurn {
 public:
  MapperInTurn(const Options& options, const MapperContext& context)
      : mapper_(options, context), filter_(options.filter) {}
  /// `frames` are the numbers of the frames that it has.
  MapperInTurn(Mapper mapper, std::vector<int> frames, const DetectionFilterOptions& filter)
      : mapper_(std::move(mapper)), frames_(std::move(frames)), filter_(filter) {}

  /// `call(mapper)`.
  template <class Call>
  auto Do(const Call& call) {
    const pybind11::gil_scoped_release release;  // before the lock: its owner may need the GIL
    const std::lock_guard lock(mutex_);
    return call(mapper_);
  }

  FrameReport AddFrame(const Frame& frame) {
    return Do([&](Mapper& mapper) {
      FrameReport report = mapper.AddFrame(frame);
      frames_.push_back(frame.index);
      return report;
    });
  }
  std::unique_ptr<MapperInTurn> Copy() {
    return Do([this](Mapper& mapper) {
      return std::make_unique<MapperInTurn>(mapper, frames_, filter_);
    });
  }
  std::pair<Trajectory, std::vector<int>> NumberedTrajectory() {
    return Do([this](Mapper& mapper) { return std::pair(mapper.CameraTrajectory(), frames_); });
  }
  const DetectionFilterOptions& filter() const { return filter_; }

 private:
  Mapper mapper_;
  std::vector<int> frames_;
  DetectionFilterOptions filter_;
  std::mutex mutex_;
};

}  // namespace sslcd::python
