# SPDX-License-Identifier: BSD-3-Clause
function(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(result)
    message(FATAL_ERROR "failed (${result}): ${ARGN}")
  endif()
endfunction()

if(SANITIZE)  # a sanitized library needs a sanitized program
  string(APPEND CXX_FLAGS " -fsanitize=${SANITIZE}")
endif()
file(REMOVE_RECURSE ${WORK_DIR})
step(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
step(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
step(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
step(${WORK_DIR}/build/consumer)
if(EXISTS ${WORK_DIR}/prefix/bin/sslcd_run)
  step(${WORK_DIR}/prefix/bin/sslcd_run version)
endif()
file(GLOB_RECURSE private ${WORK_DIR}/prefix/include/sslcd/sim/*)
if(private)
  message(FATAL_ERROR "installed, but not for users: ${private}")
endif()
