# SPDX-License-Identifier: BSD-3-Clause
# `find_package(sslcd)` defines sslcd::sslcd, and with COMPONENTS vision or store also sslcd::vision
# or sslcd::store. tests/consumer checks it. Components: library, vision, store (shared libraries),
# tools, dev.
include(CMakePackageConfigHelpers)
set(SSLCD_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/sslcd)

set(left_out)
if(NOT TARGET sslcd_vision)
  list(APPEND left_out REGEX "/sslcd/(inference|detectors|ground|visual_odometry|lifting|frontend)$"
    EXCLUDE)
endif()
if(NOT TARGET sslcd_store_lib)
  list(APPEND left_out REGEX "/sslcd/store$" EXCLUDE)
endif()
install(DIRECTORY include/sslcd ${SSLCD_GENERATED_INCLUDE_DIR}/sslcd
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev ${left_out})
install(DIRECTORY third_party/lie/include/lie
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sslcd/third_party COMPONENT dev)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT dev)
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/sslcd COMPONENT dev)

# The static and the shared library are both exported as sslcd::sslcd, so in files of their own.
# sslcdConfig.cmake chooses. What sslcd::vision links is looked for only where it is asked for.
function(sslcd_install_target target component export)
  install(TARGETS ${target} EXPORT ${export}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component} NAMELINK_COMPONENT dev)
  install(EXPORT ${export} NAMESPACE sslcd:: DESTINATION ${SSLCD_CONFIG_DIR} COMPONENT dev)
endfunction()
set_target_properties(sslcd_lie PROPERTIES EXPORT_NAME lie)
sslcd_install_target(sslcd_lie dev sslcdHeadersTargets)
sslcd_install_target(sslcd dev sslcdStaticTargets)
if(TARGET sslcd_shared)
  sslcd_install_target(sslcd_shared library sslcdSharedTargets)
endif()
if(TARGET sslcd_vision)
  sslcd_install_target(sslcd_vision dev sslcdVisionStaticTargets)
  if(TARGET sslcd_vision_shared)
    sslcd_install_target(sslcd_vision_shared vision sslcdVisionSharedTargets)
  endif()
  install(FILES cmake/SslcdOpenCV.cmake DESTINATION ${SSLCD_CONFIG_DIR} COMPONENT dev)
  install(DIRECTORY config/models DESTINATION ${CMAKE_INSTALL_DATADIR}/sslcd COMPONENT tools
    FILES_MATCHING PATTERN *.yaml)
  install(FILES config/classes.yaml DESTINATION ${CMAKE_INSTALL_DATADIR}/sslcd COMPONENT tools)
endif()
if(TARGET sslcd_store_lib)
  sslcd_install_target(sslcd_store_lib dev sslcdStoreStaticTargets)
  if(TARGET sslcd_store_lib_shared)
    sslcd_install_target(sslcd_store_lib_shared store sslcdStoreSharedTargets)
  endif()
endif()
if(TARGET sslcd_run)
  install(TARGETS sslcd_run sslcd_sim RUNTIME COMPONENT tools)
endif()

configure_package_config_file(cmake/sslcdConfig.cmake.in sslcdConfig.cmake
  INSTALL_DESTINATION ${SSLCD_CONFIG_DIR})
write_basic_package_version_file(sslcdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sslcdConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/sslcdConfigVersion.cmake
  cmake/FindFLANN.cmake DESTINATION ${SSLCD_CONFIG_DIR} COMPONENT dev)
include(SslcdPkgConfig)
