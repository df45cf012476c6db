# SPDX-License-Identifier: BSD-3-Clause
# Builds and runs the outside project against the static or shared libraries (KIND) in PREFIX.
cmake_minimum_required(VERSION 3.22)
if(SANITIZE)  # a sanitized library needs a sanitized program
  string(APPEND CXX_FLAGS " -fsanitize=${SANITIZE}")
endif()
file(REMOVE_RECURSE ${WORK_DIR})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${OUTSIDE} -B ${WORK_DIR} -G ${GENERATOR} -DKIND=${KIND}
  -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK_DIR}/consumer COMMAND_ERROR_IS_FATAL ANY)
if(EXISTS ${PREFIX}/include/sslcd/store)
  execute_process(COMMAND ${WORK_DIR}/consumer_store ${WORK_DIR}/site.db
    COMMAND_ERROR_IS_FATAL ANY)
endif()
execute_process(COMMAND ${WORK_DIR}/consumer_vision ${PREFIX}/share/sslcd/models/yolo11.yaml
  COMMAND_ERROR_IS_FATAL ANY)
