# SPDX-License-Identifier: BSD-3-Clause
# All installed headers, in both orders, compile without a warning by GCC and Clang, as C++17 and
# C++20. Before C++17 the first error says so.
cmake_minimum_required(VERSION 3.22)
file(GLOB_RECURSE headers RELATIVE ${PREFIX}/include
  ${PREFIX}/include/sslcd/*.h ${PREFIX}/include/sslcd/*/*.h)
list(FILTER headers EXCLUDE REGEX "third_party/|opencv_image\\.h$")  # on its own, the host's OpenCV
list(SORT headers)
if(NOT "sslcd/sslcd.h" IN_LIST headers OR NOT "sslcd/version.h" IN_LIST headers)
  message(FATAL_ERROR "sslcd.h or version.h is not installed")
endif()
set(text "")
foreach(header ${headers})
  string(APPEND text "#include <${header}>\n")
endforeach()
file(WRITE ${WORK_DIR}/forwards.cc "${text}")
list(REVERSE headers)
set(text "")
foreach(header ${headers})
  string(APPEND text "#include <${header}>\n")
endforeach()
file(WRITE ${WORK_DIR}/backwards.cc "${text}")

set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Werror)
set(folders -I${PREFIX}/include -I${PREFIX}/include/sslcd/third_party -isystem ${EIGEN})
find_program(clang NAMES clang++ clang++-20 clang++-19 clang++-18 clang++-17 clang++-16 clang++-15
  clang++-14)
if(NOT clang)
  set(clang "")
  message(STATUS "no clang++: its warnings are not checked")
endif()
foreach(compiler ${CXX} ${clang})
  foreach(case "17;forwards" "20;backwards")
    list(GET case 0 standard)
    list(GET case 1 order)
    execute_process(COMMAND ${compiler} -std=c++${standard} -fsyntax-only ${warnings} ${folders}
      ${WORK_DIR}/${order}.cc COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
execute_process(COMMAND ${CXX} -std=c++11 -fsyntax-only ${folders} ${WORK_DIR}/backwards.cc
  ERROR_VARIABLE message RESULT_VARIABLE result)
string(REGEX MATCH "[^\n]*error:? [^\n]*" first "${message}")
if(result EQUAL 0 OR NOT first MATCHES "sslcd needs C\\+\\+17")
  message(FATAL_ERROR "-std=c++11: the first error does not name the remedy: ${first}")
endif()
