// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if __cplusplus < 201703L
#error "sslcd needs C++17: compile with -std=c++17, and remove -std=c++11 from CMAKE_CXX_FLAGS"
#endif

/// The libraries hide their symbols. What an installed header declares is visible: its namespace
/// has this mark, as have the few private functions that sslcd::vision calls.
#define SSLCD_EXPORT [[gnu::visibility("default")]]
/// Hides the Impl of a class of an installed header.
#define SSLCD_HIDDEN [[gnu::visibility("hidden")]]
