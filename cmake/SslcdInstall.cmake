# SPDX-License-Identifier: BSD-3-Clause
# `find_package(sslcd)` defines sslcd::sslcd, and with COMPONENTS vision also sslcd::vision, for
# static and shared builds. tests/consumer checks it.
include(CMakePackageConfigHelpers)
set(SSLCD_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/sslcd)

if(NOT TARGET sslcd_vision)
  set(left_out REGEX "/sslcd/(inference|detectors|ground|visual_odometry|lifting|frontend)$"
    EXCLUDE)
endif()
install(DIRECTORY include/sslcd DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${left_out})
install(DIRECTORY third_party/lie/include/lie
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sslcd/third_party)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/sslcd)

set_target_properties(sslcd_lie PROPERTIES EXPORT_NAME lie)
install(TARGETS sslcd sslcd_lie EXPORT sslcdTargets)
install(EXPORT sslcdTargets NAMESPACE sslcd:: DESTINATION ${SSLCD_CONFIG_DIR})
# In a file of its own: what it links is looked for only where it is asked for.
if(TARGET sslcd_vision)
  set_target_properties(sslcd_vision PROPERTIES INSTALL_RPATH "$ORIGIN")
  install(TARGETS sslcd_vision EXPORT sslcdVisionTargets)
  install(EXPORT sslcdVisionTargets NAMESPACE sslcd:: DESTINATION ${SSLCD_CONFIG_DIR})
  install(FILES cmake/SslcdOpenCV.cmake DESTINATION ${SSLCD_CONFIG_DIR})
  install(DIRECTORY config/models DESTINATION ${CMAKE_INSTALL_DATADIR}/sslcd
    FILES_MATCHING PATTERN *.yaml)
  install(FILES config/classes.yaml DESTINATION ${CMAKE_INSTALL_DATADIR}/sslcd)
endif()
if(TARGET sslcd_run)  # finds a shared sslcd even if the installed tree moves
  set_target_properties(sslcd_run PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endif()

get_target_property(SSLCD_LIBRARY_TYPE sslcd TYPE)
configure_package_config_file(cmake/sslcdConfig.cmake.in sslcdConfig.cmake
  INSTALL_DESTINATION ${SSLCD_CONFIG_DIR})
write_basic_package_version_file(sslcdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sslcdConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/sslcdConfigVersion.cmake
  cmake/FindFLANN.cmake DESTINATION ${SSLCD_CONFIG_DIR})
