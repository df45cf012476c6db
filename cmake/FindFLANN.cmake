# SPDX-License-Identifier: BSD-3-Clause
# FLANN has no CMake package, and its .pc file requires HDF5 and MPI. The C++ header alone only
# needs liblz4.
find_path(FLANN_INCLUDE_DIR flann/flann.hpp)
find_library(FLANN_LZ4_LIBRARY lz4)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FLANN REQUIRED_VARS FLANN_INCLUDE_DIR FLANN_LZ4_LIBRARY)
if(FLANN_FOUND AND NOT TARGET FLANN::flann)
  add_library(FLANN::flann INTERFACE IMPORTED)
  target_include_directories(FLANN::flann SYSTEM INTERFACE ${FLANN_INCLUDE_DIR})
  target_link_libraries(FLANN::flann INTERFACE ${FLANN_LZ4_LIBRARY})
endif()
mark_as_advanced(FLANN_INCLUDE_DIR FLANN_LZ4_LIBRARY)
