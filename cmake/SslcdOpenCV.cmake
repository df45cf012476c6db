# SPDX-License-Identifier: BSD-3-Clause
# sslcd_find_opencv(core imgcodecs ...): targets opencv_core, opencv_imgcodecs, ...
# Debian and Ubuntu keep OpenCVConfig.cmake in libopencv-dev, which brings 200 more packages than
# the few modules we use. Where only those are installed, their headers and libraries are found one
# by one.
function(sslcd_find_opencv)
  find_package(OpenCV 4 QUIET COMPONENTS ${ARGN})
  if(OpenCV_FOUND)
    return()
  endif()
  find_path(SSLCD_OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
  mark_as_advanced(SSLCD_OPENCV_INCLUDE_DIR)
  foreach(component ${ARGN})
    if(TARGET opencv_${component})
      continue()
    endif()
    find_library(SSLCD_OPENCV_${component} opencv_${component})
    mark_as_advanced(SSLCD_OPENCV_${component})
    if(NOT SSLCD_OPENCV_INCLUDE_DIR OR NOT SSLCD_OPENCV_${component})
      message(FATAL_ERROR "OpenCV 4 (${component}) not found: install libopencv-${component}-dev "
                          "(scripts/install_deps.sh does), or set OpenCV_DIR")
    endif()
    add_library(opencv_${component} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(opencv_${component} PROPERTIES
      IMPORTED_LOCATION ${SSLCD_OPENCV_${component}}
      INTERFACE_INCLUDE_DIRECTORIES ${SSLCD_OPENCV_INCLUDE_DIR})
  endforeach()
endfunction()
