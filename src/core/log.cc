// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/log.h"

#include <utility>

namespace sslcd {
namespace {
LogSink& Sink() {
  static LogSink sink;
  return sink;
}
}  // namespace

LogSink SetLogSink(LogSink sink) { return std::exchange(Sink(), std::move(sink)); }

void Log(LogLevel level, const std::string& message) {
  if (Sink()) Sink()(level, message);
}

}  // namespace sslcd
