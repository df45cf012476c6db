# SPDX-License-Identifier: BSD-3-Clause
# Configures a project that has sslcd in a subfolder, without and with sslcd::vision, and compiles its
# program. Its cache and its `install` stay its own. The library is not built again: its sources and
# their flags are those of this build.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${WORK_DIR})
foreach(vision OFF ON)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/${vision} -G ${GENERATOR}
    -DSSLCD=${SSLCD} -DWITH_VISION=${vision} -DBUILD_SHARED_LIBS=${vision}
    -DCMAKE_CXX_COMPILER=${CXX} COMMAND_ERROR_IS_FATAL ANY)
  if(GENERATOR STREQUAL "Ninja")  # others build the library before it
    execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/${vision} --target host_objects
      COMMAND_ERROR_IS_FATAL ANY)
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${WORK_DIR}/${vision}
    --prefix ${WORK_DIR}/prefix OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB installed ${WORK_DIR}/prefix/*)
  if(installed)
    message(FATAL_ERROR "a host's install has ${installed}")
  endif()
  load_cache(${WORK_DIR}/${vision} READ_WITH_PREFIX host_ CMAKE_BUILD_TYPE)
  if(host_CMAKE_BUILD_TYPE)
    message(FATAL_ERROR "a host's CMAKE_BUILD_TYPE is set to ${host_CMAKE_BUILD_TYPE}")
  endif()
endforeach()
