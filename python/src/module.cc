// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>

#include <string>

#include "bindings.h"
#include "sslcd/core/error.h"
#include "sslcd/version.h"

namespace sslcd::python {
namespace {

const char* ClassOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage: return "UsageError";
    case ErrorKind::kBadInput: return "BadInputError";
    case ErrorKind::kBadConfig: return "BadConfigError";
    case ErrorKind::kNoSolution: return "NoSolutionError";
    case ErrorKind::kOutput: return "OutputError";
  }
  return "Error";
}

void Translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Error& error) {
    const py::object type = py::module_::import("sslcd.errors").attr(ClassOf(error.kind()));
    const std::string text = error.what();  // paths in it may be no UTF-8
    const auto message = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
        text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
    PyErr_SetObject(type.ptr(), message.ptr());
  }
}

// NumPy 2 has another layout of its types, which older headers of pybind11 read wrong, silently.
void CheckNumpy() {
#if PYBIND11_VERSION_HEX < 0x020C0000
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (std::stoi(version) >= 2)
    throw py::import_error("this build of sslcd needs NumPy below 2, but there is NumPy " +
                           version +
                           ": build it with pybind11 2.12 or newer, as `pip install .` does");
#endif
}

}  // namespace
}  // namespace sslcd::python

PYBIND11_MODULE(_core, module) {
  using namespace sslcd::python;
  CheckNumpy();
  pybind11::register_exception_translator(Translate);
  module.attr("__version__") = SSLCD_VERSION;
  BindAsyncMapper(module);
  BindColour(module);
  BindConfiguration(module);
  BindDatasets(module);
  BindEvaluation(module);
  BindFormats(module);
  BindGraph(module);
  BindMapper(module);
  BindMapSession(module);
  BindMaps(module);
  BindMatch(module);
  BindRosBridge(module);
  BindSiteIndex(module);
}
