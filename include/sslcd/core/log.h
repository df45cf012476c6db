// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Receives messages. ImageFrontend with several threads may call it from several of them at the
/// same time. The library never prints; it is silent until a host installs a sink.
using LogSink = std::function<void(LogLevel, const std::string&)>;

/// Installs the sink (empty: silent) and returns the previous one. Must not be called while the
/// library runs in another thread.
LogSink SetLogSink(LogSink sink);

/// Passes one line to the sink.
void Log(LogLevel level, const std::string& message);

}  // namespace sslcd
