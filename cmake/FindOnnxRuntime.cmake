# SPDX-License-Identifier: BSD-3-Clause
# ONNX Runtime's C header, as the target OnnxRuntime::headers. The library is loaded with the first
# model (src/inference/runtime.cc), so the build also runs without it.
find_path(SSLCD_ONNXRUNTIME_INCLUDE_DIR onnxruntime_c_api.h
  PATH_SUFFIXES onnxruntime onnxruntime/core/session)
mark_as_advanced(SSLCD_ONNXRUNTIME_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OnnxRuntime REQUIRED_VARS SSLCD_ONNXRUNTIME_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "no models will run: scripts/install_deps.sh vision installs it")
if(OnnxRuntime_FOUND AND NOT TARGET OnnxRuntime::headers)
  add_library(OnnxRuntime::headers INTERFACE IMPORTED)
  set_target_properties(OnnxRuntime::headers
    PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${SSLCD_ONNXRUNTIME_INCLUDE_DIR})
endif()
