# SPDX-License-Identifier: BSD-3-Clause
include(CMakePackageConfigHelpers)
install(DIRECTORY include/sslcd DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY third_party/lie/include/lie DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sslcd/third_party)
install(TARGETS sslcd sslcd_lie EXPORT sslcdTargets)
