# SPDX-License-Identifier: BSD-3-Clause
# sslcd_module(NAME LINK <lower modules>... PRIVATE <outside libraries>... WITHOUT <files>...)
#   src/NAME/*.cc, but for the files named, as an object library `sslcd_NAME`. Its LINK list is the layer rule;
#   tests/include_graph checks that the includes keep to it.
# sslcd_library(TARGET [LINK <libraries>...])
#   the modules since the last sslcd_library() as one installed library: `sslcd` as sslcd::sslcd, `sslcd_vision` as
#   sslcd::vision.
function(sslcd_module name)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE;WITHOUT" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cc)
  list(TRANSFORM ARG_WITHOUT PREPEND ${PROJECT_SOURCE_DIR}/src/${name}/)
  list(REMOVE_ITEM sources ${ARG_WITHOUT})
  add_library(sslcd_${name} OBJECT ${sources})
  target_include_directories(sslcd_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(sslcd_${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE} sslcd_compiler)
  set_target_properties(sslcd_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
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
  string(REPLACE "sslcd_" "" export_name ${target})
  add_library(${target} ${objects})
  add_library(sslcd::${export_name} ALIAS ${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_link_libraries(${target} PUBLIC sslcd_lie ${ARG_LINK} PRIVATE ${outside})
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION 0 EXPORT_NAME ${export_name})
endfunction()

# Each case that a gtest filter names is a ctest entry; or all of them together are one. They run in
# the build folder: where sources are compiled by relative names, these are relative to it.
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

# sslcd_test_module(NAME [EACH] LINK <targets>... PROPERTY|REGRESSION|SLOW <gtest patterns>...)
#   tests/NAME/*_test.cc as one executable. CONTRIBUTING.md says what the labels mean. A test that
#   no pattern names is a unit test. Unit tests are one ctest entry, property tests another: to start
#   a process for each of a thousand cases would take longer than the cases. With EACH, and for
#   REGRESSION and SLOW, each case is an entry, so that ctest lists what was skipped.
function(sslcd_test_module name)
  cmake_parse_arguments(ARG "EACH" "" "LINK;PROPERTY;REGRESSION;SLOW" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cc)
  if(NOT sources)
    return()
  endif()
  set(exe sslcd_${name}_tests)
  add_executable(${exe} ${sources})
  target_link_libraries(${exe} PRIVATE ${ARG_LINK} GTest::gmock GTest::gtest_main sslcd_compiler)

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
