# SPDX-License-Identifier: BSD-3-Clause
file(REMOVE_RECURSE ${WORK_DIR})
foreach(vision OFF ON)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/${vision} -G ${GENERATOR}
    -DSSLCD=${SSLCD}
    -DWITH_VISION=${vision} -DCMAKE_CXX_COMPILER=${CXX} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
