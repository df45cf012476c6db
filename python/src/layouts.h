// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/layout.h"

namespace sslcd::python {

/// Numbers of labels, in the order in which they are met.
using LabelNumbers = std::map<std::string, int>;

/// The objects of a sslcd.layouts.Layout, which has checked its arrays.
std::vector<LayoutObject> ObjectsFrom(const pybind11::handle& layout, LabelNumbers& numbers);

/// The Layout; labels are the numbers as texts.
pybind11::object LayoutOf(const std::vector<LayoutObject>& objects);

}  // namespace sslcd::python
