// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <mutex>
#include <utility>

namespace sslcd::python {

/// An object whose calls take turns, so that threads may share one. They run without the GIL.
template <class T>
class InTurn {
 public:
  explicit InTurn(T object) : object_(std::move(object)) {}

  /// `call(object)`.
  template <class Call>
  auto Do(const Call& call) {
    const pybind11::gil_scoped_release release;  // before the lock: its owner may need the GIL
    const std::lock_guard lock(mutex_);
    return call(object_);
  }

 private:
  T object_;
  std::mutex mutex_;
};

}  // namespace sslcd::python
