// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "sslcd/closing/place_matcher.h"

namespace sslcd::python {

/// Calls a function of Python's with a sslcd.layouts.PlaceQuery, for a PlaceAnswer or None. None:
/// sslcd's own matcher. May be copied, called and destroyed without the GIL.
PlaceMatcher PlaceMatcherFrom(const pybind11::object& function);

}  // namespace sslcd::python
