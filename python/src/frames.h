// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/perception/filter.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd::python {

namespace py = pybind11;

/// The frame of a sslcd.inputs.Frame, which has checked its arrays. Throws Error(kBadInput) if a
/// matrix is no rigid transform. Vectors of appearance are normalised; one of zeros is none.
Frame FrameFrom(const py::handle& frame);
/// The other way round. Matrices lose the last bits of a pose, so this frame comes along, for
/// FrameFrom; the arrays are read-only, so that both stay the same.
py::object ToPython(const Frame& frame);

/// Places in the frame of the detections that the mapper's filter keeps.
std::vector<int> KeptOf(const Frame& frame, const DetectionFilterOptions& options);

/// `given` has labels: symmetry ("none", "pi", "full") by label; up: [3]; camera:
/// sslcd.inputs.Camera or None; place_matcher: a function or None.
MapperContext ContextFrom(const py::dict& given);
/// The Camera or None.
py::object ToPython(const std::optional<Camera>& camera);

}  // namespace sslcd::python
