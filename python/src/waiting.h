// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace sslcd::python {

/// How often a wait looks for signals, e.g. ctrl-C.
constexpr double kLook_s = 0.1;

/// Repeats `wait(seconds)`, without the GIL, until it is true.
template <class Wait>
void WaitFor(const Wait& wait) {
  while (true) {
    {
      const pybind11::gil_scoped_release release;
      if (wait(kLook_s)) return;
    }
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }
}

}  // namespace sslcd::python
