// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace sslcd {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Where messages go. ImageFrontend with more than one thread may call it from several at a time,
/// if a model's runtime has something to say. The library is silent until a host installs a sink;
/// it never prints by itself.
using LogSink = std::function<void(LogLevel, const std::string&)>;

/// Installs the sink (empty: silent) and returns the one before. Not to be called while the library
/// runs in another thread.
LogSink SetLogSink(LogSink sink);

/// Hands one line to the sink.
void Log(LogLevel level, const std::string& message);

}  // namespace sslcd
