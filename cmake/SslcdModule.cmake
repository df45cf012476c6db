# SPDX-License-Identifier: BSD-3-Clause
# sslcd_module(NAME LINK <lower modules>... PRIVATE <outside libraries>...)
#   src/NAME/*.cc as an object library `sslcd_NAME`. Its LINK list is the layer rule; tests/include_graph checks that the
#   includes keep to it.
# sslcd_library(TARGET [LINK <libraries>...])
#   the modules since the last sslcd_library() as one installed library: `sslcd` as sslcd::sslcd, `sslcd_vision` as
#   sslcd::vision.
function(sslcd_module name)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cc)
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

# sslcd_test_module(NAME LINK <targets>...): tests/NAME/*_test.cc as one executable, each TEST a ctest entry.
function(sslcd_test_module name)
  cmake_parse_arguments(ARG "" "" "LINK;LABELS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cc)
  if(NOT sources)
    return()
  endif()
  add_executable(sslcd_${name}_tests ${sources})
  target_link_libraries(sslcd_${name}_tests PRIVATE ${ARG_LINK} GTest::gmock GTest::gtest_main sslcd_compiler)
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  gtest_discover_tests(sslcd_${name}_tests TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${ARG_LABELS}" ENVIRONMENT "SSLCD_DATA_DIR=${SSLCD_DATA_DIR}")
endfunction()
