// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/timing.h"

namespace sslcd::apps {

/// The output of the tools. Results go to stdout, everything else to stderr.
struct Console {
  bool quiet = false;    ///< nothing but errors
  bool verbose = false;  ///< debug messages too

  /// Installs a log sink that follows `quiet` and `verbose`.
  void InstallLog() const;
  /// All warnings since then, also those that `quiet` has kept from the terminal.
  std::vector<std::string> Warnings() const;

  /// One line that the next one overwrites; only on a terminal.
  void Status(const std::string& line) const;
  /// Clears it.
  void EndStatus() const;

  /// A line of human-readable result; nothing when quiet.
  void Say(const std::string& line) const;
};

/// One row per stage: calls, and times in ms.
std::string TimingText(const TimingTable& timing);

/// A message as a terminal may show it: control characters, which come from files, as \x1b, and of
/// a long one the beginning.
std::string Printable(const std::string& message);

/// Rows of cells as aligned columns, the first one left-aligned.
std::string AlignedTable(const std::vector<std::vector<std::string>>& rows);

/// printf-style number, e.g. Number("%.3f", 1.2).
std::string Number(const char* format, double value);

/// From now on ctrl-C (SIGINT), SIGTERM and SIGHUP only set a flag; a second one ends the program
/// at once. A signal that is ignored (nohup) stays ignored.
void CatchInterrupt();
bool Interrupted();
/// The exit code of a program that was interrupted: 128 and the signal's number.
int InterruptCode();

}  // namespace sslcd::apps
