// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "sslcd/core/error.h"
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
    if (owner_ == std::this_thread::get_id())
      throw Error(ErrorKind::kUsage, "a place matcher must not call its own mapper");
    const pybind11::gil_scoped_release release;  // before the lock: its owner may need the GIL
    const std::lock_guard lock(mutex_);
    const Owner owner(owner_);
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
  using Id = std::thread::id;
  // Names this thread as the owner of the lock.
  struct Owner {
    explicit Owner(std::atomic<Id>& id) : owner(id) { owner = std::this_thread::get_id(); }
    ~Owner() { owner = Id(); }
    std::atomic<Id>& owner;
  };

  Mapper mapper_;
  std::vector<int> frames_;
  DetectionFilterOptions filter_;
  std::mutex mutex_;
  std::atomic<Id> owner_{};
};

}  // namespace sslcd::python
