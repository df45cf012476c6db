# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${PREFIX}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB private ${PREFIX}/include/sslcd/sim ${PREFIX}/include/sslcd/stereo)
if(private)
  message(FATAL_ERROR "installed, but not for users: ${private}")
endif()
foreach(tool sslcd_run sslcd_sim)
  if(EXISTS ${BUILD_DIR}/apps/${tool})
    execute_process(COMMAND ${PREFIX}/bin/${tool} --help OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
