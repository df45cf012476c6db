# SPDX-License-Identifier: BSD-3-Clause
# cmake -DSOURCE_DIR=... -DOUTPUT=... -P WriteCommit.cmake: writes the commit as a C++ header if it
# has changed.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
elseif(commit MATCHES "-dirty$")  # not unique: results of different changes must not be mixed
  execute_process(COMMAND git -C ${SOURCE_DIR} diff HEAD OUTPUT_VARIABLE changes)
  string(SHA1 changes "${changes}")
  string(SUBSTRING ${changes} 0 8 changes)
  string(APPEND commit "-${changes}")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define SSLCD_COMMIT \"@commit@\"\n" @ONLY)
