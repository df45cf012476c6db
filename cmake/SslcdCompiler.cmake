# SPDX-License-Identifier: BSD-3-Clause
# Warnings, hardening, sanitizers and ccache, for sslcd's own targets only. Installed targets do not
# export them.
add_library(sslcd_compiler INTERFACE)
target_compile_options(sslcd_compiler INTERFACE -Wall -Wextra -Wshadow -Wno-unused-parameter)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # false positives in Eigen with GCC 12 to 14
  target_compile_options(sslcd_compiler INTERFACE -Wno-maybe-uninitialized)
endif()
if(SSLCD_WARNINGS_AS_ERRORS)
  target_compile_options(sslcd_compiler INTERFACE -Werror)
endif()
# The test house.hardening reads the binaries. Control-flow protection is left to the compiler's
# default: the linker drops it unless the C runtime and all static libraries have it, as in Ubuntu.
set(SSLCD_LINK_HARDENED)
if(SSLCD_HARDEN AND CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT SSLCD_SANITIZE)
  set(SSLCD_LINK_HARDENED LINKER:-z,relro,-z,now)
  target_link_options(sslcd_compiler INTERFACE ${SSLCD_LINK_HARDENED})
  target_compile_options(sslcd_compiler INTERFACE -fstack-protector-strong
    "$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
endif()
if(SSLCD_SANITIZE)
  add_compile_options(-fsanitize=${SSLCD_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${SSLCD_SANITIZE})
  # Under AddressSanitizer Eigen uses another allocator, which cannot free matrices that Ceres has
  # allocated.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1 _GLIBCXX_ASSERTIONS)
endif()
find_program(SSLCD_CCACHE ccache)
if(SSLCD_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env  # for the headers that tests precompile
    CCACHE_SLOPPINESS=pch_defines,time_macros ${SSLCD_CCACHE})
endif()
