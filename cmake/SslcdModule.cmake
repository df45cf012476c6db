# SPDX-License-Identifier: BSD-3-Clause
# sslcd_room(NAME LINK <lower modules>...)
#   the headers of a module: <build>/rooms/NAME has symbolic links to include/sslcd/NAME and to
#   src/NAME, and is the include path of `sslcd_NAME_headers`, which hands on those of the modules
#   linked. A header of any other module is not found, so an include that goes up does not compile.
#   The LINK list has to be what the includes name, no less and no more: tests/include_graph.
# sslcd_module(NAME LINK <lower modules>... PRIVATE <outside libraries>...)
#   a room, and src/NAME/*.cc as an object library `sslcd_NAME`.
# sslcd_use_rooms(TARGET <modules>...)
#   private headers for a program: a tool, a benchmark, a test.
# sslcd_library(TARGET [LINK <libraries>...])
#   the modules since the last sslcd_library() as an installed library: `sslcd`, `sslcd_vision`, and
#   libsslcd_store as `sslcd_store_lib`, since a module has that name. It
#   is static; tools and tests, which use private headers, link it. With SSLCD_BUILD_SHARED there is
#   also TARGET_shared, of the same objects, which shows only what installed headers declare.
#   sslcd::sslcd and sslcd::vision are the shared ones if BUILD_SHARED_LIBS is on.
function(sslcd_room name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  set(room ${PROJECT_BINARY_DIR}/rooms/${name})
  file(MAKE_DIRECTORY ${room}/sslcd)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${name} ${room}/${name} SYMBOLIC)
  if(EXISTS ${PROJECT_SOURCE_DIR}/include/sslcd/${name})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/include/sslcd/${name} ${room}/sslcd/${name} SYMBOLIC)
  endif()
  add_library(sslcd_${name}_headers INTERFACE)
  target_include_directories(sslcd_${name}_headers INTERFACE ${room})
  target_link_libraries(sslcd_${name}_headers INTERFACE sslcd_lie)
  foreach(link ${ARG_LINK})
    target_link_libraries(sslcd_${name}_headers INTERFACE sslcd_${link}_headers)
  endforeach()
endfunction()

function(sslcd_use_rooms target)
  foreach(room ${ARGN})
    target_link_libraries(${target} PRIVATE sslcd_${room}_headers)
  endforeach()
endfunction()

function(sslcd_module name)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cc)
  sslcd_room(${name} LINK ${ARG_LINK})
  add_library(sslcd_${name} OBJECT ${sources})
  target_link_libraries(sslcd_${name} PRIVATE sslcd_${name}_headers ${ARG_PRIVATE} sslcd_compiler)
  set_target_properties(sslcd_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  set_property(GLOBAL APPEND PROPERTY SSLCD_OBJECT_LIBRARIES ${name})
  set_property(GLOBAL APPEND PROPERTY SSLCD_MODULES ${name})
  set_property(GLOBAL APPEND PROPERTY SSLCD_OUTSIDE_LIBRARIES ${ARG_PRIVATE})
endfunction()

function(sslcd_library target)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  get_property(modules GLOBAL PROPERTY SSLCD_MODULES)
  get_property(outside GLOBAL PROPERTY SSLCD_OUTSIDE_LIBRARIES)
  set_property(GLOBAL PROPERTY SSLCD_MODULES)
  set_property(GLOBAL PROPERTY SSLCD_OUTSIDE_LIBRARIES)
  list(REMOVE_DUPLICATES outside)
  set(objects)
  foreach(module ${modules})
    list(APPEND objects $<TARGET_OBJECTS:sslcd_${module}>)
  endforeach()
  string(REGEX REPLACE "_lib$" "" output_name ${target})
  string(REPLACE "sslcd_" "" export_name ${output_name})

  add_library(${target} STATIC ${objects})
  target_link_libraries(${target} PUBLIC ${ARG_LINK})
  set(kinds ${target})
  if(SSLCD_BUILD_SHARED OR BUILD_SHARED_LIBS)
    add_library(${target}_shared SHARED ${objects})
    list(TRANSFORM ARG_LINK APPEND _shared)
    target_link_libraries(${target}_shared PUBLIC ${ARG_LINK})
    set_target_properties(${target}_shared PROPERTIES
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
      LINK_DEPENDS ${SSLCD_SYMBOLS} INSTALL_RPATH $ORIGIN BUILD_WITH_INSTALL_RPATH ON)
    target_link_options(${target}_shared PRIVATE LINKER:--version-script=${SSLCD_SYMBOLS}
      ${SSLCD_LINK_HARDENED})
    if(NOT SSLCD_SANITIZE)
      target_link_options(${target}_shared PRIVATE LINKER:-z,defs)
    endif()
    list(APPEND kinds ${target}_shared)
  endif()
  foreach(kind ${kinds})
    target_include_directories(${kind} PUBLIC
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
      $<BUILD_INTERFACE:${SSLCD_GENERATED_INCLUDE_DIR}>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_compile_features(${kind} PUBLIC cxx_std_17)
    target_link_libraries(${kind} PUBLIC sslcd_lie PRIVATE ${outside})
    set_target_properties(${kind} PROPERTIES EXPORT_NAME ${export_name}
      OUTPUT_NAME ${output_name})
  endforeach()
  if(BUILD_SHARED_LIBS)
    add_library(sslcd::${export_name} ALIAS ${target}_shared)
  else()
    add_library(sslcd::${export_name} ALIAS ${target})
  endif()
endfunction()

# Adds the cases of a gtest filter to ctest, as one entry each or together. They run in the build
# folder, which relative source names refer to.
function(sslcd_test_cases name filter label)
  gtest_discover_tests(sslcd_${name}_tests TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
    TEST_FILTER "${filter}" WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
    PROPERTIES LABELS ${label} ENVIRONMENT "SSLCD_DATA_DIR=${SSLCD_DATA_DIR}")
endfunction()

function(sslcd_test_process name label filter)
  add_test(NAME ${name}.${label} COMMAND sslcd_${name}_tests --gtest_filter=${filter}
    WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
  set_tests_properties(${name}.${label} PROPERTIES LABELS ${label})
endfunction()

# The headers that nearly every test includes, compiled once. They hide no missing include: a test
# file still compiles without them (-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON).
function(sslcd_precompile_test_headers exe)
  set(pch $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)  # for ccache
  if(NOT TARGET sslcd_test_headers)
    file(WRITE ${PROJECT_BINARY_DIR}/tests/test_headers.cc "")
    add_library(sslcd_test_headers OBJECT ${PROJECT_BINARY_DIR}/tests/test_headers.cc)
    target_link_libraries(sslcd_test_headers PRIVATE sslcd_lie GTest::gmock sslcd_compiler)
    target_compile_options(sslcd_test_headers PRIVATE ${pch})
    target_precompile_headers(sslcd_test_headers PRIVATE
      <gmock/gmock.h> <gtest/gtest.h> <Eigen/Dense> <filesystem> <fstream> <map> <random> <set>)
  endif()
  target_precompile_headers(${exe} REUSE_FROM sslcd_test_headers)
  target_compile_options(${exe} PRIVATE ${pch})
endfunction()

# sslcd_test_module(NAME [EACH] LINK <targets>... ROOMS <modules>...
#                   PROPERTY|REGRESSION|SLOW <gtest patterns>...)
#   tests/NAME/*_test.cc as one executable, which sees the private headers of the module NAME and of
#   ROOMS. CONTRIBUTING.md says what the labels mean. A test that no pattern names is a unit test.
#   Unit tests are one ctest entry, property tests another: to start a process for each of a
#   thousand cases would take longer than the cases. With EACH, and for REGRESSION and SLOW, each
#   case is an entry, so that ctest lists what was skipped.
function(sslcd_test_module name)
  cmake_parse_arguments(ARG "EACH" "" "LINK;ROOMS;PROPERTY;REGRESSION;SLOW" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cc)
  if(NOT sources)
    return()
  endif()
  set(exe sslcd_${name}_tests)
  add_executable(${exe} ${sources})
  target_link_libraries(${exe} PRIVATE ${ARG_LINK} GTest::gmock GTest::gtest_main sslcd_compiler)
  sslcd_precompile_test_headers(${exe})
  if(TARGET sslcd_${name}_headers)
    list(APPEND ARG_ROOMS ${name})
  endif()
  sslcd_use_rooms(${exe} ${ARG_ROOMS})

  list(JOIN ARG_PROPERTY ":" property)
  list(JOIN ARG_REGRESSION ":" regression)
  list(JOIN ARG_SLOW ":" slow)
  string(JOIN ":" others ${ARG_PROPERTY} ${ARG_REGRESSION} ${ARG_SLOW})
  if(ARG_EACH)
    sslcd_test_cases(${name} "-${others}" unit)
  elseif(NOT others STREQUAL "*")
    sslcd_test_process(${name} unit "-${others}")
  endif()
  if(property)
    sslcd_test_process(${name} property "${property}")
  endif()
  if(regression)
    sslcd_test_cases(${name} "${regression}-${slow}" regression)
  endif()
  if(slow)
    sslcd_test_cases(${name} "${slow}" slow)
  endif()
endfunction()
