// SPDX-License-Identifier: BSD-3-Clause
#include "console.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <mutex>

#include "sslcd/core/log.h"

namespace sslcd::apps {
namespace {

// lock-free, so a handler may set it and any thread read it
std::atomic<int> g_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

// ctrl-C, and what batch systems and closing terminals send
constexpr int kEnding[] = {SIGINT, SIGTERM, SIGHUP};

extern "C" void OnInterrupt(int number) {
  g_signal = number;
  for (const int each : kEnding) std::signal(each, SIG_DFL);
}

// Threads may log at the same time.
std::mutex g_warnings_mutex;
std::vector<std::string> g_warnings;

std::atomic<bool> g_status_shown{false};

spdlog::level::level_enum SpdlogLevel(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug: return spdlog::level::debug;
    case LogLevel::kInfo: return spdlog::level::info;
    case LogLevel::kWarning: return spdlog::level::warn;
    case LogLevel::kError: return spdlog::level::err;
  }
  return spdlog::level::err;
}

void ClearStatus() {
  if (g_status_shown.exchange(false)) std::fprintf(stderr, "\r\033[K");
}

}  // namespace

std::vector<std::string> Console::Warnings() const {
  const std::lock_guard<std::mutex> lock(g_warnings_mutex);
  return g_warnings;
}

void Console::InstallLog() const {
  const auto logger = spdlog::stderr_color_mt("sslcd");
  logger->set_pattern("%^%l:%$ %v");
  logger->set_level(quiet     ? spdlog::level::err
                    : verbose ? spdlog::level::debug
                              : spdlog::level::warn);
  SetLogSink([logger](LogLevel level, const std::string& raw) {
    const std::string message = Printable(raw);
    if (logger->should_log(SpdlogLevel(level))) ClearStatus();
    if (level == LogLevel::kWarning) {
      const std::lock_guard<std::mutex> lock(g_warnings_mutex);
      g_warnings.push_back(message);
    }
    logger->log(SpdlogLevel(level), message);
  });
}

void Console::Status(const std::string& line) const {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  if (quiet || !terminal) return;
  std::fprintf(stderr, "\r\033[K%s ", line.c_str());
  g_status_shown = true;
}

void Console::EndStatus() const { ClearStatus(); }

void Console::Say(const std::string& line) const {
  if (quiet) return;
  ClearStatus();
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);  // also in a pipe: whoever waits there wants to know
}

std::string Printable(const std::string& message) {
  constexpr std::size_t kLongest = 4000;
  std::string text;
  for (const char c : message.substr(0, kLongest)) {
    const auto code = static_cast<unsigned char>(c);
    if ((code < 0x20 && c != '\n') || code == 0x7f) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\x%02x", code);
      text += escaped;
    } else {
      text += c;
    }
  }
  return message.size() > kLongest ? text + "..." : text;
}

std::string AlignedTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width;
  for (const auto& row : rows) {
    width.resize(std::max(width.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string pad(width[c] - row[c].size(), ' ');
      line += (c ? "  " : "  ") + (c ? pad + row[c] : row[c] + pad);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  if (!text.empty()) text.pop_back();
  return text;
}

std::string Number(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string TimingText(const TimingTable& timing) {
  std::vector<std::vector<std::string>> rows = {{"stage", "calls", "p50 ms", "p95 ms", "max ms"}};
  for (const auto& [stage, t] : timing.Summary())
    rows.push_back({stage, std::to_string(t.count), Number("%.2f", t.p50), Number("%.2f", t.p95),
                    Number("%.2f", t.max)});
  return AlignedTable(rows);
}

void CatchInterrupt() {
  for (const int each : kEnding)
    if (std::signal(each, OnInterrupt) == SIG_IGN) std::signal(each, SIG_IGN);  // nohup
}

bool Interrupted() { return g_signal != 0; }

int InterruptCode() {
  constexpr int kBySignal = 128;
  return kBySignal + g_signal;
}

}  // namespace sslcd::apps
