// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>

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
    PyErr_SetString(type.ptr(), error.what());
  }
}

}  // namespace
}  // namespace sslcd::python

PYBIND11_MODULE(_core, module) {
  using namespace sslcd::python;
  pybind11::register_exception_translator(Translate);
  module.attr("__version__") = SSLCD_VERSION;
  BindAsyncMapper(module);
  BindConfiguration(module);
  BindDatasets(module);
  BindEvaluation(module);
  BindFormats(module);
  BindGraph(module);
  BindMapper(module);
  BindMatch(module);
}
