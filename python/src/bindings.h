// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace sslcd::python {

namespace py = pybind11;

/// Each adds its classes and functions to the module. python/sslcd wraps and documents them.
void BindAsyncMapper(py::module_& module);
void BindColour(py::module_& module);
void BindConfiguration(py::module_& module);
void BindDatasets(py::module_& module);
void BindEvaluation(py::module_& module);
void BindFormats(py::module_& module);
void BindGraph(py::module_& module);
void BindMapper(py::module_& module);
void BindMapSession(py::module_& module);
void BindMaps(py::module_& module);
void BindMatch(py::module_& module);
void BindRosBridge(py::module_& module);
void BindSiteIndex(py::module_& module);

}  // namespace sslcd::python
