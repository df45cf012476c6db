# SPDX-License-Identifier: BSD-3-Clause
# Builds the examples alone against PREFIX and runs them.
cmake_minimum_required(VERSION 3.22)
if(SANITIZE)
  string(APPEND CXX_FLAGS " -fsanitize=${SANITIZE}")
endif()
file(REMOVE_RECURSE ${WORK_DIR})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${EXAMPLES} -B ${WORK_DIR} -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS} -Werror"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB programs ${WORK_DIR}/0*_*)
execute_process(COMMAND ${PYTHON} -B ${TEST} ${programs} COMMAND_ERROR_IS_FATAL ANY)
